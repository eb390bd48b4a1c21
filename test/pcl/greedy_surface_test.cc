#include <ceres_ed/pcl/greedy_surface.h>

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Points of a cap of a sphere at distances of about `spacing`, as a grid over its tangent plane.
void MakeCap(double spacing,
             std::vector<Eigen::Vector3d>* points,
             std::vector<Eigen::Vector3d>* normals) {
  for (int y = -10; y <= 10; ++y) {
    for (int x = -10; x <= 10; ++x) {
      // Rows are shifted, so that no four points lie on a circle.
      const double u = (x + 0.37 * (y % 2)) / 20.0;
      const double v = 0.9 * y / 20.0;
      const Eigen::Vector3d normal(u, v, std::sqrt(1.0 - u * u - v * v));
      normals->push_back(normal);
      points->push_back(20.0 * spacing * normal + Eigen::Vector3d(3.0, -2.0, 50.0) * spacing);
    }
  }
}

double AreaOf(const std::vector<Eigen::Vector3d>& points, const SurfaceTriangles& triangles) {
  double area = 0.0;
  for (const auto& t : triangles) {
    area += 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
  }
  return area;
}

TEST(GreedySurface, CoversACapAndFacesAlongTheNormals) {
  std::vector<Eigen::Vector3d> points, normals;
  MakeCap(1.0, &points, &normals);
  SurfaceTriangles triangles;
  ASSERT_TRUE(ConnectByGreedyProjection(points, normals, 4.0, &triangles).ok());
  // Its projection to the plane has 20 x 18 squares, and a cap is larger than that.
  const double area = AreaOf(points, triangles);
  EXPECT_GT(area, 20.0 * 18.0);
  EXPECT_LT(area, 1.3 * 20.0 * 18.0);
  for (const auto& t : triangles) {
    const Eigen::Vector3d side = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
    EXPECT_GT(side.dot(normals[t[0]]), 0.0);
    for (int k = 0; k < 3; ++k) EXPECT_LT((points[t[k]] - points[t[(k + 1) % 3]]).norm(), 4.0);
  }
}

TEST(GreedySurface, IsTheSameInAnyUnit) {
  std::vector<Eigen::Vector3d> metres, millimetres, normals, same;
  MakeCap(1.0 / 1024.0, &metres, &normals);
  MakeCap(1.0, &millimetres, &same);
  SurfaceTriangles a, b;
  ASSERT_TRUE(ConnectByGreedyProjection(metres, normals, 4.0 / 1024.0, &a).ok());
  ASSERT_TRUE(ConnectByGreedyProjection(millimetres, same, 4.0, &b).ok());
  EXPECT_EQ(a, b);
}

TEST(GreedySurface, OfNothingIsEmpty) {
  SurfaceTriangles triangles = {{0, 1, 2}};
  EXPECT_TRUE(ConnectByGreedyProjection({}, {}, 1.0, &triangles).ok());
  EXPECT_TRUE(triangles.empty());
}

}  // namespace
}  // namespace ceres_ed
