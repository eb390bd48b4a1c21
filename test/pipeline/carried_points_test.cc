#include "ceres_ed/pipeline/fit/carried_points.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// A roof of two triangles.
PointCloud Roof() {
  PointCloud roof;
  roof.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {0, 2, 1}};
  roof.triangles = {{0, 1, 2}, {0, 2, 3}};
  return roof;
}

Similarity SomeMotion() {
  Similarity motion;
  motion.scale = 3.0;
  motion.rotation = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 3).normalized());
  motion.translation = {10, -20, 30};
  return motion;
}

const std::vector<Eigen::Vector3d> kPoints = {
    {1, 0.5, 0.25}, {0.5, 1.5, 2.0}, {2, 2, 1}, {-1, -1, 0.5}};

TEST(CarryPoints, FollowASimilarityOnAndBesideTriangles) {
  const PointCloud roof = Roof();
  const Similarity motion = SomeMotion();
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& point : roof.points) moved.push_back(motion * point);
  // The overall motion is not needed where there are triangles.
  const auto carried = CarryPoints(roof, moved, Similarity(), kPoints);
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    EXPECT_LT((carried[i] - motion * kPoints[i]).norm(), 1e-12) << "point " << i;
  }
}

TEST(CarryPoints, FollowTheOverallMotionWhereThereAreNoTriangles) {
  PointCloud roof = Roof();
  const Similarity motion = SomeMotion();
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& point : roof.points) moved.push_back(motion * point);
  roof.triangles.clear();
  const auto bare = CarryPoints(roof, moved, motion, kPoints);
  roof.triangles = {{0, 1, 1}};
  const auto flat = CarryPoints(roof, moved, motion, kPoints);
  for (std::size_t i = 0; i < kPoints.size(); ++i) {
    EXPECT_LT((bare[i] - motion * kPoints[i]).norm(), 1e-12) << "point " << i;
    EXPECT_LT((flat[i] - motion * kPoints[i]).norm(), 1e-12) << "point " << i;
  }
}

TEST(CarryPoints, APointInATriangleKeepsItsBarycentricCoordinates) {
  const PointCloud roof = Roof();
  std::vector<Eigen::Vector3d> moved = roof.points;
  moved[2] += Eigen::Vector3d(1, 2, 3);
  // (1, 0.5, 0.25) = 1/2 * corner 0 + 1/4 * corner 1 + 1/4 * corner 2.
  const auto carried = CarryPoints(roof, moved, Similarity(), {kPoints[0]});
  EXPECT_LT((carried[0] - kPoints[0] - 0.25 * Eigen::Vector3d(1, 2, 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace ceres_ed
