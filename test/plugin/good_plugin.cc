// A plugin with an energy that pulls every node's translation to zero.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/plugin/plugin_abi.h>

namespace {

struct AnchorCost {
  static constexpr int kNumResiduals = 3;

  template <typename T>
  bool operator()(const T* node, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = gain * node[ceres_ed::kNodeTranslationOffset + i];
    return true;
  }

  double gain;
};

ceres_ed::Status RegisterAnchor(ceres_ed::EnergyRegistry* registry) {
  ceres_ed::EnergyInfo info;
  info.name = "anchor";
  info.summary = "pulls every node's translation to zero";
  info.equation = "gain * t_j";
  info.unit = "map unit";
  info.parameters = {ceres_ed::RealParameter("gain", "-", 0, 10, 2, "factor of the residual")};
  return registry->Register(info, [](const ceres_ed::ParameterValues& values) {
    const AnchorCost anchor{values.Get("gain")};
    return ceres_ed::ForEachNode(ceres_ed::EnergyKind::kPrior,
                                 [anchor](const ceres_ed::EnergyContext&, int) { return anchor; });
  });
}

}  // namespace

CERES_ED_PLUGIN(RegisterAnchor)
