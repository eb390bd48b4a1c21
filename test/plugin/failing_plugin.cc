// A plugin whose register function returns an error.
#include <ceres_ed/plugin/plugin_abi.h>

static ceres_ed::Status Refuse(ceres_ed::EnergyRegistry*) {
  return ceres_ed::Status::Error("needs a licence file");
}

CERES_ED_PLUGIN(Refuse)
