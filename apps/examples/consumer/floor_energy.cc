// An energy of your own as a plugin: ed_fit ... --plugin=./floor.so --energy=floor:height=-0.1
#include <ceres_ed/energy/point_energy.h>
#include <ceres_ed/plugin/plugin_abi.h>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a plugin, not a header

namespace {

// What the energy says of one warped point.
struct FloorFunctor {
  static constexpr int kNumResiduals = 1;
  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = point[2] < height ? height - point[2] : T(0.0);
    return true;
  }
  double height;
};

// Where its residuals are: on every point.
struct FloorEnergy : EnergyTerm {
  explicit FloorEnergy(double height) : floor{height} {}
  EnergyKind kind() const override { return EnergyKind::kPrior; }
  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    const int num_points = static_cast<int>(context.points->size());
    for (int i = 0; i < num_points; ++i) AddPointResidual(context, i, floor, 1.0, sink);
  }
  FloorFunctor floor;
};

Status RegisterFloor(EnergyRegistry* registry) {
  EnergyParameter height{"height", ParameterType::kReal, "diagonals", -10.0, 10.0, 0.0, "z of it"};
  const char* equation = "max(0, height - v~_z)";
  EnergyInfo info{"floor", "no point below it", equation, "length", EnergyKind::kPrior, {height}};
  return registry->Register(std::move(info), [](const auto& values) {
    return std::make_unique<FloorEnergy>(values.Get("height"));
  });
}
}  // namespace
CERES_ED_PLUGIN(RegisterFloor)
