#include "ceres_ed/registration/rigid/rigid_registration.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/rigid/rigid_starts.h>
#include <ceres_ed/simulation/shapes.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

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

// Returns a closed stick of 1 x 0.1 x 0.1 with square ends, as a lattice of `along` x `across` x
// `across` cells.
PointCloud MakeStick(int along, int across) {
  const std::array<int, 3> cells = {along, across, across};
  PointCloud stick;
  std::map<std::array<int, 3>, int> index;
  const auto corner = [&](const std::array<int, 3>& at) {
    const auto [entry, is_new] = index.emplace(at, static_cast<int>(stick.points.size()));
    if (is_new) {
      stick.points.emplace_back(double(at[0]) / along, 0.1 * at[1] / across, 0.1 * at[2] / across);
    }
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const bool is_far : {false, true}) {
      for (int i = 0; i < cells[u]; ++i) {
        for (int j = 0; j < cells[v]; ++j) {
          const auto at = [&](int du, int dv) {
            std::array<int, 3> place{};
            place[axis] = is_far ? cells[axis] : 0;
            place[u] = i + du;
            place[v] = j + dv;
            return corner(place);
          };
          const std::array<int, 4> q = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
          for (std::array<int, 3> t : {std::array<int, 3>{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}) {
            if (!is_far) std::swap(t[1], t[2]);
            stick.triangles.push_back(t);
          }
        }
      }
    }
  }
  return stick;
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

// Only the small ends determine the place of a stick along its axis.
TEST(RigidRegistration, PutsTheEndsOfAStickOnEachOther) {
  const PointCloud stick = MakeStick(60, 6);
  const Similarity truth = MakePose(25.0, {0.2, 1.0, 0.5}, {0.05, 0.02, -0.03});
  const RigidResult result = AlignRigid(
      Surface(stick), Surface(Moved(truth, MakeStick(53, 5))), Similarity(), RigidOptions());
  EXPECT_LT(LargestGap(truth, result.target_from_source, stick), 0.1);
}

// Gentle waves determine the place of a sheet within its plane.
TEST(RigidRegistration, PutsAWavySheetInItsPlace) {
  const auto make = [](int columns, int rows) {
    PointCloud sheet = MakeGridMesh(columns, rows);
    for (Eigen::Vector3d& point : sheet.points) {
      const double x = point.x() / (columns - 1.0);
      const double y = 0.8 * point.y() / (rows - 1.0);
      point = {x, y, 0.04 * std::sin(5.0 * x) * std::cos(4.0 * y)};
    }
    return sheet;
  };
  const PointCloud sheet = make(60, 50);
  const Similarity truth = MakePose(15.0, {0.5, -0.4, 1.0}, {0.02, 0.03, -0.01});
  const RigidResult result =
      AlignRigid(Surface(sheet), Surface(Moved(truth, make(55, 47))), Similarity(), RigidOptions());
  EXPECT_LT(LargestGap(truth, result.target_from_source, sheet), 0.2);
}

// Distances across a flat sheet do not determine its place within its plane, but its borders do.
TEST(RigidRegistration, LaysTheBordersOfAFlatSheetOnEachOther) {
  const auto make = [](int columns, int rows) {
    PointCloud sheet = MakeGridMesh(columns, rows);
    for (Eigen::Vector3d& point : sheet.points) {
      point = {point.x() / (columns - 1.0), 0.8 * point.y() / (rows - 1.0), 0.0};
    }
    return sheet;
  };
  const PointCloud sheet = make(60, 50);
  const Similarity truth = MakePose(5.0, {0.0, 0.0, 1.0}, {0.05, -0.01, 0.0});
  const RigidResult result =
      AlignRigid(Surface(sheet), Surface(Moved(truth, make(55, 47))), Similarity(), RigidOptions());
  EXPECT_LT(LargestGap(truth, result.target_from_source, sheet), 0.5);
}

// From any other unit, as long as the scale is asked for.
TEST(RigidRegistration, RecoversAnyScale) {
  const PointCloud body = MakeSyntheticShape(SyntheticShape::kDolphin, 1500, 1.0);
  RigidOptions options;
  options.with_scale = true;
  for (const double scale : {1e-3, 0.05, 5.0, 20.0, 100.0, 1000.0}) {
    const Similarity truth = MakePose(35.0, {0.3, -1.0, 0.5}, {1.2, -0.4, 0.8}, scale);
    const RigidResult result =
        AlignRigid(Surface(body), Surface(Moved(truth, body)), Similarity(), options);
    EXPECT_LT(LargestGap(truth, result.target_from_source, body), 0.1) << scale;
  }
}

// Nothing is asserted of the pose: a search from another unit must end, and say that it is bad.
TEST(RigidRegistration, EndsWhereTheUnitsDiffer) {
  const PointCloud body = MakeSyntheticShape(SyntheticShape::kDolphin, 500, 1.0);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6}) {
    const PointCloud other = Moved(MakePose(35.0, {0.3, -1.0, 0.5}, {1.2, 0.0, 0.0}, scale), body);
    EXPECT_GT(AlignRigid(Surface(body), Surface(other), Similarity(), RigidOptions()).score, 0.1)
        << scale;
  }
}

// Distances do not determine the position of a flat sheet within a larger one, so it keeps it.
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
  EXPECT_EQ(result.starts_tried, 0);
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
