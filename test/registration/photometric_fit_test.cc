// Fits a textured sheet that has slid along itself, so that only its brightness shows the motion.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/registration/fit.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// The displacement of the source, which is less than a quarter of a wave of the texture.
const Eigen::Vector3d kSlide(0.06, -0.04, 0.0);
constexpr double kWaveNumber = 2.0 * M_PI / 0.8;
constexpr double kSpacing = 0.025;

double Texture(const Eigen::Vector3d& place) {
  return 0.5 + 0.2 * std::sin(kWaveNumber * place.x()) + 0.2 * std::cos(kWaveNumber * place.y());
}

// Returns a flat square around `center`, with the texture at an offset `look` from each point.
PointCloud MakeSheet(int side, const Eigen::Vector3d& center, const Eigen::Vector3d& look) {
  PointCloud sheet;
  const double half = 0.5 * kSpacing * (side - 1);
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      sheet.points.push_back(center +
                             Eigen::Vector3d(kSpacing * c - half, kSpacing * r - half, 0.0));
      sheet.intensities.push_back(Texture(sheet.points.back() + look));
    }
  }
  for (int r = 0; r + 1 < side; ++r) {
    for (int c = 0; c + 1 < side; ++c) {
      const int a = r * side + c;
      sheet.triangles.push_back({a, a + 1, a + side});
      sheet.triangles.push_back({a + 1, a + side + 1, a + side});
    }
  }
  return sheet;
}

FitInput SlidSheet() {
  FitInput input;
  input.source = MakeSheet(41, {0.007, 0.011, 0.0}, kSlide);
  input.target = MakeSheet(81, {0.0, 0.0, 0.0}, Eigen::Vector3d::Zero());
  return input;
}

struct Motion {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  // The largest distance of a point from its correct position.
  double largest_error = 0.0;
};

// Returns options with which the sheet keeps its initial stiffness: at an extremum of the texture
// only the stiffness holds a point along it.
FitOptions StiffOptions() {
  FitOptions options;
  options.finish = false;
  options.schedule.final_stiffness = options.schedule.initial_stiffness;
  return options;
}

// Fits with the photometric energy of this weight, or without any energy of a user.
Motion FitMotion(const FitInput& input, FitOptions options, std::optional<double> weight) {
  const EnergyRegistry registry = BuiltinEnergies();
  if (weight) options.extra_energies = {{"photometric", *weight, {}, {}}};
  const StatusOr<FitResult> result = Fit(input, options, registry);
  EXPECT_TRUE(result.ok() && result->IsUsable());
  Motion motion;
  for (std::size_t p = 0; p < input.source.size(); ++p) {
    const Eigen::Vector3d step = result->points[p] - input.source.points[p];
    motion.mean += step / static_cast<double>(input.source.size());
    motion.largest_error = std::max(motion.largest_error, (step - kSlide).norm());
  }
  return motion;
}

// Linear interpolation between points has an error from the texture's curvature: spacing^2 * wave
// number / 8 as a distance. The fit converges within 2e-4 of the source's diagonal.
constexpr double kTolerance = kSpacing * kSpacing * kWaveNumber / 8.0 + 2e-4 * 1.4142135623730951;

TEST(PhotometricFit, RecoversASlideThatDistancesDoNotSee) {
  const FitInput input = SlidSheet();
  const Motion with = FitMotion(input, StiffOptions(), 1.0);
  EXPECT_LT((with.mean - kSlide).norm(), kTolerance);
  EXPECT_LT(with.largest_error, kTolerance);
  const Motion without = FitMotion(input, StiffOptions(), std::nullopt);
  EXPECT_GT((without.mean - kSlide).norm(), 0.9 * kSlide.norm());
}

// The borders of bare points are not known, so the part of the target beyond the source must be too
// far away.
TEST(PhotometricFit, DoesSoOnBarePoints) {
  FitInput input = SlidSheet();
  input.source.triangles.clear();
  input.target.triangles.clear();
  FitOptions options = StiffOptions();
  options.matching.max_distance = 2.0 * kSpacing;
  const Motion with = FitMotion(input, options, 1.0);
  EXPECT_LT((with.mean - kSlide).norm(), kTolerance);
  const Motion without = FitMotion(input, options, std::nullopt);
  EXPECT_GT((without.mean - kSlide).norm(), 0.9 * kSlide.norm());
}

// With the low final stiffness of the defaults, points can slip along the extrema.
TEST(PhotometricFit, ComesNearTheSlideAsFitsAreByDefault) {
  FitOptions options;
  options.finish = false;
  const Motion with = FitMotion(SlidSheet(), options, 1.0);
  EXPECT_LT((with.mean - kSlide).norm(), 0.1 * kSlide.norm());
}

TEST(PhotometricFit, ChangesNothingWhereOneCloudHasNoBrightness) {
  FitInput input = SlidSheet();
  input.target.intensities.clear();
  const Motion with = FitMotion(input, StiffOptions(), 1.0);
  const Motion without = FitMotion(input, StiffOptions(), 0.0);
  EXPECT_EQ(with.mean, without.mean);
}

}  // namespace
}  // namespace ceres_ed
