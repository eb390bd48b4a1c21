// Energies of the user in the whole fit, the finish included.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// max(0, height - z): no point sinks below a height.
struct FloorFunctor {
  static constexpr int kNumResiduals = 1;

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = point[2] < T(height) ? T(height) - point[2] : T(0.0);
    return true;
  }

  double height;
};

EnergyRegistry RegistryWithFloor(double height) {
  EnergyRegistry registry = BuiltinEnergies();
  EnergyInfo info;
  info.name = "floor";
  info.summary = "no point sinks below a height";
  info.equation = "max(0, height - v~_z)";
  info.unit = "length";
  const Status status = registry.Register(info, [height](const ParameterValues&) {
    return ForEachPoint(EnergyKind::kPrior,
                        [height](const EnergyContext&, int) { return FloorFunctor{height}; });
  });
  CHECK(status.ok()) << status.message();
  return registry;
}

// A sheet of the width 2 whose target has a narrow groove, which only the finish can follow.
FitInput Groove() {
  FitInput input;
  input.source = MakeGridMesh(61, 61, 1.0 / 30.0);
  input.target = input.source;
  for (Eigen::Vector3d& point : input.target.points) {
    point.z() = -0.02 * std::exp(-std::pow((point.x() - 1.0) / 0.06, 2));
  }
  return input;
}

double Lowest(const FitResult& fit) {
  double lowest = 0.0;
  for (const Eigen::Vector3d& point : fit.points) lowest = std::min(lowest, point.z());
  return lowest;
}

TEST(OwnEnergies, HoldInTheFinish) {
  const FitInput input = Groove();
  FitOptions options;
  options.rigid_first = false;
  const StatusOr<FitResult> free = Fit(input, options, BuiltinEnergies());
  EnergySpec floor;
  floor.name = "floor";
  floor.weight = 1e7;
  options.extra_energies = {floor};
  // In the unit frame the origin is the centre of the source, so the sheet lies at 0.
  const StatusOr<FitResult> held = Fit(input, options, RegistryWithFloor(-0.001));
  ASSERT_TRUE(free.ok() && held.ok()) << held.status().message();
  EXPECT_LT(Lowest(*free), -0.008);
  const double diagonal = std::sqrt(8.0);
  EXPECT_GT(Lowest(*held), -1.5 * 0.001 * diagonal);
}

TEST(OwnEnergies, AWeakOneChangesTheFinishLittle) {
  const FitInput input = Groove();
  FitOptions options;
  options.rigid_first = false;
  const StatusOr<FitResult> free = Fit(input, options, BuiltinEnergies());
  EnergySpec floor;
  floor.name = "floor";
  floor.weight = 1e-6;
  options.extra_energies = {floor};
  const StatusOr<FitResult> held = Fit(input, options, RegistryWithFloor(0.0));
  ASSERT_TRUE(free.ok() && held.ok());
  for (std::size_t p = 0; p < free->points.size(); ++p) {
    EXPECT_LT((free->points[p] - held->points[p]).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace ceres_ed
