// An energy of your own as a plugin: ed_fit ... --plugin=./floor.so --energy=floor:height=-0.1
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/plugin/plugin_abi.h>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a plugin, not a header

namespace {

// The residual of one warped point.
struct FloorFunctor {
  static constexpr int kNumResiduals = 1;
  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = point[2] < height ? height - point[2] : T(0.0);
    return true;
  }
  double height;
};

Status RegisterFloor(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "floor";
  info.summary = "no point sinks below a height";
  info.equation = "max(0, height - v~_z)";
  info.unit = "length";
  info.parameters = {RealParameter("height", "source diagonals", -10, 10, 0, "z of the floor")};
  return registry->Register(info, [](const ParameterValues& values) {
    const FloorFunctor floor{values.Get("height")};
    return ForEachPoint(EnergyKind::kPrior, [floor](const EnergyContext&, int) { return floor; });
  });
}

}  // namespace

CERES_ED_PLUGIN(RegisterFloor)
