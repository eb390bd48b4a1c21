// Aligns targets that show a part of the source, rotated far away, deformed and noisy.
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/rigid/rigid_registration.h>
#include <ceres_ed/simulation/deformations.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/simulation/views.h>

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kSize = 0.1;
constexpr SyntheticShape kShape = SyntheticShape::kStomach;

struct PartialPair {
  PointCloud source;
  // Every source vertex in the frame of the target.
  PointCloud truth;
  PointCloud target;
  double overlap = 0.0;
};

// Returns the side of a deformed body that a near camera sees, rotated by `angle_deg` and moved by
// more than its own length.
PartialPair MakePartialPair(double angle_deg, double noise, double phase = 0.5) {
  PartialPair pair;
  pair.source = MakeSyntheticShape(kShape, 3000, kSize);
  pair.truth = DeformSyntheticShape(kShape, kSize, phase, pair.source);
  Similarity motion;
  motion.rotation =
      Eigen::AngleAxisd(angle_deg * M_PI / 180.0, Eigen::Vector3d(0.4, -0.3, 0.8).normalized());
  if (angle_deg > 0.0) motion.translation = Eigen::Vector3d(0.12, -0.05, 0.03);
  SyntheticView view;
  view.eye = Eigen::Vector3d(0.04, -0.13, 0.03);
  pair.target = VisiblePart(pair.truth, view);
  pair.overlap = static_cast<double>(pair.target.size()) / static_cast<double>(pair.source.size());
  for (PointCloud* cloud : {&pair.truth, &pair.target}) {
    for (Eigen::Vector3d& point : cloud->points) point = motion * point;
    cloud->normals.clear();
  }
  AddSyntheticNoise(noise, 7, &pair.target);
  return pair;
}

// Returns the mean distance from the truth in percent of the source's diagonal.
double MeanError(const PartialPair& pair, const Similarity& pose) {
  double sum = 0.0;
  for (std::size_t i = 0; i < pair.source.size(); ++i) {
    sum += (pose * pair.source.points[i] - pair.truth.points[i]).norm();
  }
  return 100.0 * sum / (static_cast<double>(pair.source.size()) * Diagonal(pair.source.points));
}

double LeastError(const PartialPair& pair) {
  return MeanError(pair, *Similarity::FitPoints(pair.source.points, pair.truth.points));
}

class RigidPartialTarget : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(RigidPartialTarget, IsFoundWhereverItIs) {
  const auto [angle, noise_percent] = GetParam();
  const PartialPair pair = MakePartialPair(angle, 0.01 * noise_percent * kSize);
  EXPECT_LT(pair.overlap, 0.5);
  const RigidResult result =
      AlignRigid(Surface(pair.source), Surface(pair.target), Similarity(), RigidOptions());
  EXPECT_GT(MeanError(pair, Similarity()), 30.0);
  // The unseen part deforms too, which no rigid alignment can know. Noise adds a slide along the
  // smooth side, which is no more than what the deformation can correct.
  const double slack = noise_percent > 1.0 ? 2.0 : 1.0;
  EXPECT_LT(MeanError(pair, result.target_from_source), 1.5 * LeastError(pair) + slack);
}

INSTANTIATE_TEST_SUITE_P(DegreesAndNoise,
                         RigidPartialTarget,
                         testing::Combine(testing::Values(47.0, 120.0, 180.0),
                                          testing::Values(0.0, 1.0, 2.0)));

TEST(RigidPartial, NearItsPlaceIsNotSearchedFor) {
  const PartialPair pair = MakePartialPair(0.0, 0.0, 0.1);
  const RigidResult result =
      AlignRigid(Surface(pair.source), Surface(pair.target), Similarity(), RigidOptions());
  EXPECT_EQ(result.starts_tried, 1);
  EXPECT_LT(MeanError(pair, result.target_from_source), 1.5 * LeastError(pair) + 1.0);
}

// The search must run and still keep the pose.
TEST(RigidPartial, NearItsPlaceIsNotMovedAwayByTheSearch) {
  const PartialPair pair = MakePartialPair(0.0, 0.0);
  RigidOptions options;
  options.good_score = 0.0;
  const RigidResult result =
      AlignRigid(Surface(pair.source), Surface(pair.target), Similarity(), options);
  EXPECT_GT(result.starts_tried, 5);
  EXPECT_LT(MeanError(pair, result.target_from_source), 1.5 * LeastError(pair) + 1.0);
}

TEST(RigidPartial, SmallerSourceIsFoundToo) {
  const PartialPair pair = MakePartialPair(120.0, 0.0);
  const RigidResult there =
      AlignRigid(Surface(pair.target), Surface(pair.source), Similarity(), RigidOptions());
  EXPECT_LT(MeanError(pair, there.target_from_source.Inverse()), 1.5 * LeastError(pair) + 1.0);
}

TEST(RigidPartial, ThreadsChangeNoBit) {
  const PartialPair pair = MakePartialPair(120.0, 0.01 * kSize);
  RigidOptions options;
  const RigidResult one =
      AlignRigid(Surface(pair.source), Surface(pair.target), Similarity(), options);
  options.num_threads = 2;
  const RigidResult two =
      AlignRigid(Surface(pair.source), Surface(pair.target), Similarity(), options);
  EXPECT_EQ(one.target_from_source.rotation.coeffs(), two.target_from_source.rotation.coeffs());
  EXPECT_EQ(one.target_from_source.translation, two.target_from_source.translation);
  EXPECT_EQ(one.score, two.score);
}

TEST(RigidPartial, UnitChangesNothing) {
  PartialPair pair = MakePartialPair(120.0, 0.0);
  const RigidResult metres =
      AlignRigid(Surface(pair.source), Surface(pair.target), Similarity(), RigidOptions());
  for (Eigen::Vector3d& point : pair.source.points) point *= 1000.0;
  for (Eigen::Vector3d& point : pair.target.points) point *= 1000.0;
  const RigidResult millimetres =
      AlignRigid(Surface(pair.source), Surface(pair.target), Similarity(), RigidOptions());
  EXPECT_LT(
      metres.target_from_source.rotation.angularDistance(millimetres.target_from_source.rotation),
      1e-6);
  EXPECT_LT(
      (1000.0 * metres.target_from_source.translation - millimetres.target_from_source.translation)
          .norm(),
      1e-4);
}

}  // namespace
}  // namespace ceres_ed
