#include "ceres_ed/registration/rigid/rigid_registration.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/rigid/rigid_starts.h>
#include <ceres_ed/simulation/shapes.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kDegree = M_PI / 180.0;

Similarity MakePose(double angle_deg,
                    const Eigen::Vector3d& axis,
                    const Eigen::Vector3d& translation,
                    double scale = 1.0) {
  Similarity pose;
  pose.scale = scale;
  pose.rotation = Eigen::AngleAxisd(angle_deg * kDegree, axis.normalized());
  pose.translation = translation;
  return pose;
}

PointCloud Moved(const Similarity& pose, const PointCloud& cloud) {
  PointCloud moved = cloud;
  for (Eigen::Vector3d& point : moved.points) point = pose * point;
  moved.normals.clear();
  return moved;
}

// Returns the largest distance between the points under two poses, in percent of their diagonal.
double LargestGap(const Similarity& a, const Similarity& b, const PointCloud& cloud) {
  double gap = 0.0;
  for (const Eigen::Vector3d& point : cloud.points) {
    gap = std::max(gap, (a * point - b * point).norm());
  }
  return 100.0 * gap / (a.scale * Diagonal(cloud.points));
}

class RigidRegistrationOfTurns : public testing::TestWithParam<double> {};

// Small and large rotations; the target is a whole body length away.
TEST_P(RigidRegistrationOfTurns, RecoversTheMotionOfACopy) {
  const PointCloud body = MakeSyntheticShape(SyntheticShape::kDolphin, 1500, 1.0);
  const Similarity truth = MakePose(GetParam(), {0.3, -1.0, 0.5}, {1.2, -0.4, 0.8});
  const RigidResult result =
      AlignRigid(Surface(body), Surface(Moved(truth, body)), Similarity(), RigidOptions());
  EXPECT_LT(LargestGap(truth, result.target_from_source, body), 1e-3);
  EXPECT_LT(result.score, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Degrees,
                         RigidRegistrationOfTurns,
                         testing::Values(10.0, 47.0, 90.0, 135.0, 180.0));

TEST(RigidRegistration, RecoversAScaleWhenAsked) {
  const PointCloud body = MakeSyntheticShape(SyntheticShape::kStomach, 1500, 0.1);
  const Similarity truth = MakePose(20.0, {0.0, 1.0, 0.3}, {0.01, 0.02, 0.0}, 1.15);
  RigidOptions options;
  options.with_scale = true;
  const RigidResult result =
      AlignRigid(Surface(body), Surface(Moved(truth, body)), Similarity(), options);
  EXPECT_NEAR(result.target_from_source.scale, truth.scale, 1e-4);
  EXPECT_LT(LargestGap(truth, result.target_from_source, body), 0.05);
}

// Distances do not determine the position of a flat sheet in its plane, so it keeps it.
TEST(RigidRegistration, LeavesWhatNothingDetermines) {
  const PointCloud sheet = MakeSyntheticShape(SyntheticShape::kPlane, 900, 0.2);
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : sheet.points) center += point / sheet.size();
  // The target is larger than the source, so that no border attracts it, and it is raised by 2 mm.
  PointCloud target = sheet;
  const Eigen::Vector3d lift(0.0, 0.0, 0.002);
  for (Eigen::Vector3d& point : target.points) point = center + 1.5 * (point - center) + lift;
  target.normals.clear();
  const RigidResult result =
      AlignRigid(Surface(sheet), Surface(target), Similarity(), RigidOptions());
  Similarity lifted;
  lifted.translation = lift;
  EXPECT_LT(LargestGap(lifted, result.target_from_source, sheet), 0.1);
}

TEST(RigidRegistration, StopsWhenAsked) {
  const PointCloud body = MakeSyntheticShape(SyntheticShape::kHeart, 800, 0.1);
  RigidOptions options;
  options.should_stop = [] { return true; };
  const RigidResult result = AlignRigid(
      Surface(body), Surface(Moved(MakePose(120.0, {1, 1, 0}, {0, 0, 0}), body)), {}, options);
  EXPECT_EQ(result.starts_tried, 1);
  EXPECT_TRUE(result.target_from_source.translation.allFinite());
}

TEST(RigidRegistration, OptionsOutOfRangeAreNamed) {
  std::string error;
  EXPECT_TRUE(RigidOptions().IsValid(&error)) << error;
  RigidOptions options;
  options.score_width = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_NE(error.find("score_width is 0"), std::string::npos) << error;
}

TEST(RigidStarts, AreProperRotationsThatAlignTheCentroids) {
  const PointCloud from = MakeSyntheticShape(SyntheticShape::kKidney, 700, 0.1);
  const PointCloud to = MakeSyntheticShape(SyntheticShape::kHeart, 700, 0.1);
  Eigen::Vector3d from_center = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : from.points) from_center += point / from.size();
  for (const Eigen::Vector3d& point : to.points) to_center += point / to.size();
  const std::vector<Similarity> starts = RigidStarts(from.points, to.points, Similarity());
  ASSERT_EQ(starts.size(), 1u + 4u);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_NEAR(starts[i].rotation.toRotationMatrix().determinant(), 1.0, 1e-12) << i;
    EXPECT_LT((starts[i] * from_center - to_center).norm(), 1e-12) << i;
  }
}

}  // namespace
}  // namespace ceres_ed
