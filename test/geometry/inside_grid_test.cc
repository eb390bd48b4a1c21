#include "ceres_ed/geometry/inside_grid.h"

#include <ceres_ed/geometry/orientation.h>

#include <cmath>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(InsideGrid, TellsInsideFromOutside) {
  const PointCloud ball = MakeSphereMesh(3);
  const InsideGrid grid(ball, 0.05);
  EXPECT_NEAR(grid.Volume(), 4.0 / 3.0 * kPi, 0.03 * 4.0 / 3.0 * kPi);
  EXPECT_TRUE(grid.IsInside({0.0, 0.0, 0.0}));
  EXPECT_TRUE(grid.IsInside({0.5, -0.5, 0.5}));
  EXPECT_FALSE(grid.IsInside({0.65, 0.65, 0.65}));
  EXPECT_FALSE(grid.IsInside({5.0, 0.0, 0.0}));
  EXPECT_FALSE(grid.IsInside({NAN, 0.0, 0.0}));
}

TEST(InsideGrid, DoesNotDependOnWhichSideIsOut) {
  PointCloud ball = MakeSphereMesh(3);
  const double volume = InsideGrid(ball, 0.05).Volume();
  ReverseOrientation(&ball);
  EXPECT_EQ(InsideGrid(ball, 0.05).Volume(), volume);
}

TEST(InsideGrid, AHoleDoesNotEmptyTheBody) {
  PointCloud ball = MakeSphereMesh(3);
  const double volume = InsideGrid(ball, 0.05).Volume();
  ball.triangles.erase(ball.triangles.begin());
  EXPECT_NEAR(InsideGrid(ball, 0.05).Volume(), volume, 0.02 * volume);
}

TEST(InsideGrid, AnOpenSheetEnclosesNothing) {
  const PointCloud sheet = MakeGridMesh(21, 21, 0.05);
  EXPECT_EQ(InsideGrid(sheet, 0.05).Volume(), 0.0);
}

TEST(InsideGrid, SegmentsBetweenTwoBodiesAreNotInside) {
  PointCloud balls = MakeSphereMesh(3);
  const PointCloud other = MakeSphereMesh(3);
  const int offset = static_cast<int>(balls.size());
  for (const Eigen::Vector3d& point : other.points) {
    balls.points.push_back(point + Eigen::Vector3d(2.5, 0.0, 0.0));
  }
  for (const auto& [a, b, c] : other.triangles) {
    balls.triangles.push_back({a + offset, b + offset, c + offset});
  }
  const InsideGrid grid(balls, 0.05);
  EXPECT_TRUE(grid.IsSegmentInside({-0.9, 0.0, 0.0}, {0.9, 0.0, 0.0}));
  EXPECT_TRUE(grid.IsSegmentInside({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(grid.IsSegmentInside({0.0, 0.0, 0.0}, {2.5, 0.0, 0.0}));
}

TEST(InsideGrid, ACloudWithoutTrianglesEnclosesNothing) {
  PointCloud ball = MakeSphereMesh(2);
  ball.triangles.clear();
  const InsideGrid grid(ball, 0.1);
  EXPECT_EQ(grid.Volume(), 0.0);
  EXPECT_FALSE(grid.IsInside({0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace ceres_ed
