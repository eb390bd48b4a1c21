// A plugin that says that it was built against an older Eigen. Its register function must never be
// called.
#include <ceres_ed/plugin/plugin_abi.h>

#include <cstdlib>
#include <string>

extern "C" __attribute__((visibility("default"))) const char* CERES_ED_PLUGIN_ABI_SYMBOL() {
  static const std::string abi = [] {
    std::string text = CERES_ED_PLUGIN_ABI;
    const std::size_t eigen = text.find(";Eigen ") + 1;
    return text.replace(eigen, text.find(';', eigen) - eigen, "Eigen 3.3.9");
  }();
  return abi.c_str();
}

extern "C" __attribute__((visibility("default"))) void CERES_ED_PLUGIN_REGISTER_SYMBOL(
    ceres_ed::EnergyRegistry*, ceres_ed::Status*) {
  std::abort();
}
