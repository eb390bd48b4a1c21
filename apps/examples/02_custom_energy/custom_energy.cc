// An energy of your own: a floor that no point may sink through, written as a functor on a warped
// point. A sheet is held at one edge and pulled down in the middle. Its free half sinks even lower,
// unless there is a floor.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/testing/energy_laws.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

using namespace ceres_ed;  // NOLINT(google-build-using-namespace): a program, not a header

namespace {

// The residual of one point. Ceres differentiates it, and the library supplies the warp.
struct FloorFunctor {
  static constexpr int kNumResiduals = 1;

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = point[2] < height ? height - point[2] : T(0.0);
    return true;
  }

  double height;
};

// Describes the energy to users, and adds a residual on every point. It is a prior, because it
// observes nothing. The same function makes a plugin: CERES_ED_PLUGIN(RegisterFloor).
Status RegisterFloor(EnergyRegistry* registry) {
  EnergyInfo info;
  info.name = "floor";
  info.summary = "no point sinks below a height";
  info.equation = "max(0, height - v~_z)";
  info.unit = "length";
  info.parameters = {RealParameter(
      "height", "source diagonals above the source's centre", -10, 10, 0, "where the floor is")};
  return registry->Register(info, [](const ParameterValues& values) {
    const FloorFunctor floor{values.Get("height")};
    return ForEachPoint(EnergyKind::kPrior, [floor](const EnergyContext&, int) { return floor; });
  });
}

constexpr int kSide = 21;
constexpr int kMiddle = kSide / 2;

// Returns a sheet of kSide x kSide points around the origin with a diagonal of 1.
PointCloud MakeSheet() {
  const double step = 1.0 / (std::sqrt(2.0) * (kSide - 1));
  PointCloud sheet;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int column = i % kSide;
    const int row = i / kSide;
    sheet.points.push_back(step * Eigen::Vector3d(column - kMiddle, row - kMiddle, 0.0));
    if (column + 1 == kSide || row + 1 == kSide) continue;
    sheet.triangles.push_back({i, i + 1, i + kSide});
    sheet.triangles.push_back({i + 1, i + kSide + 1, i + kSide});
  }
  return sheet;
}

// Returns the height of the lowest point of the fitted sheet.
double LowestPoint(const EnergyRegistry& registry, const std::vector<EnergySpec>& energies) {
  FitInput input;
  input.source = MakeSheet();
  for (int i = 0; i < kSide; ++i) {
    input.fixed_points.push_back(kSide * i);
    const int middle = kSide * i + kSide / 2;
    input.landmarks.push_back({middle, input.source.points[middle] - Eigen::Vector3d(0, 0, 0.1)});
  }
  FitOptions options;
  options.extra_energies = energies;
  const StatusOr<FitResult> fit = Fit(input, options, registry);
  CHECK(fit.ok()) << fit.status().message();
  CHECK(fit->IsUsable()) << fit->message;
  double lowest = 0.0;
  for (const Eigen::Vector3d& point : fit->points) lowest = std::min(lowest, point.z());
  return lowest;
}

}  // namespace

int main() {
  EnergyRegistry registry = BuiltinEnergies();
  CHECK(RegisterFloor(&registry).ok());

  EnergyClaims claims;
  // All points are below this floor, so their residuals are not zero even at rest.
  claims.parameters["height"] = 5.0;
  claims.squared_norm_at_rest = std::nullopt;
  const std::vector<std::string> violations = CheckEnergyLaws(registry, "floor", claims);
  for (const std::string& violation : violations) std::printf("%s\n", violation.c_str());

  EnergySpec floor;
  floor.name = "floor";
  floor.weight = 1e4;
  floor.parameters["height"] = -0.12;
  const double without = LowestPoint(registry, {});
  const double with = LowestPoint(registry, {floor});
  std::printf("lowest point: %.3f without the floor, %.3f with it at -0.12\n", without, with);
  return violations.empty() && without < -0.15 && with > -0.125 ? 0 : 1;
}
