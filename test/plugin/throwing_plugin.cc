// A plugin whose register function throws.
#include <ceres_ed/plugin/plugin_abi.h>

#include <stdexcept>

namespace {

ceres_ed::Status RegisterThrowing(ceres_ed::EnergyRegistry*) {
  throw std::runtime_error("cannot find its table");
}

}  // namespace

CERES_ED_PLUGIN(RegisterThrowing)
