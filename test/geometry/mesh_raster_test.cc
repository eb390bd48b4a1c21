#include <ceres_ed/geometry/mesh_raster.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

PinholeCamera Camera() { return {70.0, 65.0, 31.0, 24.5, 64, 48}; }

// Returns the depth of the nearest triangle on the ray of a pixel, computed from the barycentric
// weights, or 0 if there is none.
double CastRay(const std::vector<Eigen::Vector3d>& points,
               const Triangles& triangles,
               const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles) {
    Eigen::Matrix3d system;
    system << points[b] - points[a], points[c] - points[a], -ray;
    const Eigen::Vector3d x = system.fullPivLu().solve(-points[a]);
    if (x.x() < 0 || x.y() < 0 || x.x() + x.y() > 1 || x.z() <= 0) continue;
    nearest = std::min(nearest, x.z());
  }
  return std::isinf(nearest) ? 0.0 : nearest;
}

TEST(RasterizeMesh, GivesTheDepthOfATiltedPlaneInClosedForm) {
  // The plane n . p = d, as two triangles that extend beyond the picture.
  const Eigen::Vector3d n = Eigen::Vector3d(0.4, -0.3, 1.0).normalized();
  const double d = 0.2;
  std::vector<Eigen::Vector3d> points;
  for (const auto& [x, y] : {std::pair(-0.3, -0.3), {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}) {
    points.emplace_back(x, y, (d - n.x() * x - n.y() * y) / n.z());
  }
  const MeshRaster raster = RasterizeMesh(points, {{0, 1, 2}, {0, 2, 3}}, Camera());
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const double expected = d / n.dot(Camera().BackProject(u, v, 1.0));
      ASSERT_NEAR(raster.depth(u, v), expected, 1e-7) << u << " " << v;
    }
  }
}

TEST(RasterizeMesh, SeesWhatARayOfItsOwnHits) {
  PointCloud mesh = MakeSyntheticShape(SyntheticShape::kStomach, 800, 0.1);
  for (Eigen::Vector3d& point : mesh.points) point.z() += 0.13;
  const MeshRaster raster = RasterizeMesh(mesh.points, mesh.triangles, Camera());
  int seen = 0;
  for (int v = 1; v < 48; v += 3) {
    for (int u = 2; u < 64; u += 3) {
      const Eigen::Vector3d ray = Camera().BackProject(u, v, 1.0);
      const double expected = CastRay(mesh.points, mesh.triangles, ray);
      ASSERT_NEAR(raster.depth(u, v), expected, 1e-7) << u << " " << v;
      ASSERT_EQ(raster.fragments(u, v).triangle >= 0, expected > 0.0);
      if (expected > 0.0) ++seen;
    }
  }
  EXPECT_GT(seen, 50);
  EXPECT_LT(seen, 250);
}

TEST(RasterizeMesh, InterpolatesInSpaceNotInThePicture) {
  const std::vector<Eigen::Vector3d> points = {
      {-0.3, -0.2, 0.2}, {0.5, -0.3, 0.9}, {0.05, 0.4, 0.4}};
  const Triangles triangles = {{0, 1, 2}};
  const MeshRaster raster = RasterizeMesh(points, triangles, Camera());
  int seen = 0;
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      if (raster.fragments(u, v).triangle < 0) continue;
      ++seen;
      const Eigen::Vector3d expected = Camera().BackProject(u, v, double(raster.depth(u, v)));
      ASSERT_LT((raster.Interpolate(triangles, points, u, v) - expected).norm(), 1e-6);
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(RasterizeMesh, KeepsTheNearerOfTwoInAnyOrder) {
  const std::vector<Eigen::Vector3d> points = {
      {-1, -1, 0.5}, {1, -1, 0.5}, {0, 1, 0.5}, {-1, -1, 0.3}, {1, -1, 0.3}, {0, 1, 0.3}};
  for (const Triangles& triangles : {Triangles{{0, 1, 2}, {3, 4, 5}}, {{3, 4, 5}, {0, 1, 2}}}) {
    EXPECT_FLOAT_EQ(RasterizeMesh(points, triangles, Camera()).depth(31, 24), 0.3F);
  }
}

TEST(RasterizeMesh, LeavesOutWhatReachesBehindTheCamera) {
  const MeshRaster raster =
      RasterizeMesh({{-1, -1, 0.5}, {1, -1, 0.5}, {0, 1, -0.5}}, {{0, 1, 2}}, Camera());
  const auto& depth = raster.depth.pixels();
  EXPECT_TRUE(std::all_of(depth.begin(), depth.end(), [](float z) { return z == 0.0F; }));
}

TEST(RasterizeMesh, LeavesNoCracksInAFineMesh) {
  // There are far more triangles than pixels, with vertices and edges exactly on pixel centres.
  PointCloud plane = MakeSyntheticShape(SyntheticShape::kPlane, 10000, 0.4);
  for (Eigen::Vector3d& point : plane.points) point.z() += 0.2;
  const PinholeCamera camera = {50.0, 50.0, 32.0, 24.0, 64, 48};
  const MeshRaster raster = RasterizeMesh(plane.points, plane.triangles, camera);
  for (const float z : raster.depth.pixels()) ASSERT_FLOAT_EQ(z, 0.2F);
}

}  // namespace
}  // namespace ceres_ed
