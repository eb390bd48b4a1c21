// Fits to noisy targets.
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/simulation/pairs.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/simulation/views.h>

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

double MeanError(const std::vector<Eigen::Vector3d>& points, const PointCloud& truth) {
  double sum = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p) sum += (points[p] - truth.points[p]).norm();
  return sum / static_cast<double>(points.size());
}

// Returns the error that remains after the best rigid motion, which is determined from the truth
// itself.
double BestRigidError(const SyntheticPair& pair) {
  const StatusOr<Similarity> best =
      Similarity::FitPoints(pair.source.points, pair.truth.points, false);
  EXPECT_TRUE(best.ok());
  std::vector<Eigen::Vector3d> moved = pair.source.points;
  for (Eigen::Vector3d& point : moved) point = *best * point;
  return MeanError(moved, pair.truth);
}

class NoisyTarget : public ::testing::TestWithParam<std::string> {};

TEST_P(NoisyTarget, IsFittedBetterThanByTheBestRigidMotion) {
  SyntheticPair pair = MakeSyntheticPair(GetParam());
  const double sigma = 0.01 * Diagonal(pair.target.points);
  AddSyntheticNoise(sigma, 77, &pair.target);
  const StatusOr<FitResult> fit = Fit(pair.source, pair.target);
  ASSERT_TRUE(fit.ok()) << fit.status().message();
  ASSERT_TRUE(fit->IsUsable()) << fit->message;
  EXPECT_LT(MeanError(fit->points, pair.truth), BestRigidError(pair));
  // The accuracy of the estimate.
  EXPECT_NEAR(fit->noise, sigma, 0.15 * sigma);
}

INSTANTIATE_TEST_SUITE_P(Pairs,
                         NoisyTarget,
                         ::testing::Values("kidney_partial", "stomach_partial"),
                         [](const auto& info) { return info.param; });

TEST(FitNoise, IsInTheUnitOfTheTarget) {
  PointCloud source = MakeSyntheticShape(SyntheticShape::kKidney, 1000, 1.0);
  PointCloud target = MakeSyntheticShape(SyntheticShape::kKidney, 1200, 1.0);
  AddSyntheticNoise(0.01, 5, &target);
  const StatusOr<FitResult> fit = Fit(source, target);
  ASSERT_TRUE(fit.ok()) << fit.status().message();
  EXPECT_NEAR(fit->noise, 0.01, 0.15 * 0.01);
  for (Eigen::Vector3d& point : source.points) point *= 1000.0;
  for (Eigen::Vector3d& point : target.points) point *= 1000.0;
  const StatusOr<FitResult> in_other_unit = Fit(source, target);
  ASSERT_TRUE(in_other_unit.ok()) << in_other_unit.status().message();
  EXPECT_NEAR(in_other_unit->noise, 1000.0 * fit->noise, 1e-6 * 1000.0 * fit->noise);
}

}  // namespace
}  // namespace ceres_ed
