// A plugin with an energy of every point, which benchmarks compare with the same function of
// Python.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/plugin/plugin_abi.h>

namespace {

// The point's distance from a bowl, along z.
struct BowlFunctor {
  static constexpr int kNumResiduals = 1;

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = point[2] - depth * (point[0] * point[0] + point[1] * point[1]);
    return true;
  }

  double depth;
};

ceres_ed::Status RegisterBowl(ceres_ed::EnergyRegistry* registry) {
  ceres_ed::EnergyInfo info;
  info.name = "bowl";
  info.summary = "draws points to a bowl around z";
  info.equation = "p_z - depth (p_x^2 + p_y^2)";
  info.unit = "map unit";
  info.parameters = {ceres_ed::RealParameter("depth", "-", 0, 10, 0.5, "how steep the bowl is")};
  return registry->Register(info, [](const ceres_ed::ParameterValues& values) {
    const BowlFunctor bowl{values.Get("depth")};
    return ceres_ed::ForEachPoint(ceres_ed::EnergyKind::kPrior,
                                  [bowl](const ceres_ed::EnergyContext&, int) { return bowl; });
  });
}

}  // namespace

CERES_ED_PLUGIN(RegisterBowl)
