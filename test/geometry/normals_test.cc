#include <ceres_ed/geometry/normals.h>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

TEST(ComputeVertexNormals, OnASpherePointOutward) {
  const PointCloud mesh = MakeSphereMesh(4);
  const std::vector<Eigen::Vector3d> normals = ComputeVertexNormals(mesh);
  for (std::size_t p = 0; p < mesh.size(); ++p) {
    EXPECT_NEAR(normals[p].norm(), 1.0, 1e-14);
    // Edges are about 0.07 long, and the error of a vertex normal is of second order in that
    // length.
    EXPECT_GT(normals[p].dot(mesh.points[p]), 1.0 - 1e-5);
  }
}

TEST(ComputeVertexNormals, DoNotDependOnHowAFaceIsCut) {
  // The corner of a cube. One of its three faces is divided into two at the corner.
  PointCloud mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  mesh.triangles = {{0, 4, 1}, {0, 2, 4}, {0, 1, 3}, {0, 3, 2}};
  const Eigen::Vector3d expected = Eigen::Vector3d(-1, -1, -1).normalized();
  EXPECT_LT((ComputeVertexNormals(mesh)[0] - expected).norm(), 1e-14);
}

TEST(ComputeVertexNormals, AreSharedByPointsAtTheSamePosition) {
  const PointCloud mesh = MakeSphereMesh(1);
  std::vector<int> source;
  const PointCloud soup = Unweld(mesh, &source);
  const std::vector<Eigen::Vector3d> welded = ComputeVertexNormals(mesh);
  const std::vector<Eigen::Vector3d> unwelded = ComputeVertexNormals(soup);
  for (std::size_t p = 0; p < soup.size(); ++p) {
    EXPECT_LT((unwelded[p] - welded[source[p]]).norm(), 1e-14);
  }
}

TEST(ComputeVertexNormals, AreTheSameAtSomePointsAlone) {
  std::vector<int> source;
  PointCloud soup = Unweld(MakeSphereMesh(1), &source);
  soup.points.emplace_back(9, 9, 9);
  const std::vector<Eigen::Vector3d> all = ComputeVertexNormals(soup);
  // Among them are several at one position, and one without a triangle.
  std::vector<int> points;
  for (int p = static_cast<int>(soup.size()) - 1; p >= 0; p -= 2) points.push_back(p);
  const std::vector<Eigen::Vector3d> some =
      ComputeVertexNormalsAt(points, soup, BuildTopology(soup));
  ASSERT_EQ(some.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(some[i], all[points[i]]);
}

TEST(ComputeVertexNormals, AreZeroWhereThereIsNoArea) {
  PointCloud mesh = MakeGridMesh(2, 2);
  mesh.points.emplace_back(9, 9, 9);
  mesh.points.emplace_back(9, 9, 10);
  mesh.triangles.push_back({4, 5, 4});
  const std::vector<Eigen::Vector3d> normals = ComputeVertexNormals(mesh);
  EXPECT_EQ(normals[4], Eigen::Vector3d::Zero());
  EXPECT_EQ(normals[5], Eigen::Vector3d::Zero());
  EXPECT_EQ(normals[0], Eigen::Vector3d::UnitZ());
}

TEST(EstimateNormals, OnTheBarePointsOfASpherePointOutward) {
  PointCloud cloud = MakeSphereMesh(4);
  const std::vector<Eigen::Vector3d> normals = EstimateNormals(cloud.points);
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    EXPECT_GT(normals[p].dot(cloud.points[p]), 0.999);
  }
}

TEST(EstimateNormals, PointTheSameWayAllOverAConcaveShape) {
  // A torus: the normals of its inner half point toward the axis, so a test for each point alone
  // would be wrong.
  std::vector<Eigen::Vector3d> points, truth;
  for (int i = 0; i < 80; ++i) {
    for (int k = 0; k < 30; ++k) {
      const double u = 2.0 * M_PI * i / 80, v = 2.0 * M_PI * k / 30;
      truth.emplace_back(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
      points.push_back(Eigen::Vector3d(2.0 * std::cos(u), 2.0 * std::sin(u), 0.0) +
                       0.7 * truth.back());
    }
  }
  const std::vector<Eigen::Vector3d> normals = EstimateNormals(points);
  for (std::size_t p = 0; p < points.size(); ++p) EXPECT_GT(normals[p].dot(truth[p]), 0.98);
}

TEST(EstimateNormals, DoNotDependOnTheThreads) {
  const std::vector<Eigen::Vector3d> points = RandomPoints(300, 31);
  EXPECT_EQ(EstimateNormals(points, 8, 1), EstimateNormals(points, 8, 3));
}

TEST(EstimateNormals, AreZeroWherePointsDoNotSpanAPlane) {
  const std::vector<Eigen::Vector3d> line = MakeGridMesh(20, 1).points;
  for (const Eigen::Vector3d& normal : EstimateNormals(line)) {
    EXPECT_EQ(normal, Eigen::Vector3d::Zero());
  }
  const std::vector<Eigen::Vector3d> two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(EstimateNormals(two), std::vector<Eigen::Vector3d>(2, Eigen::Vector3d::Zero()));
  const std::vector<Eigen::Vector3d> one_place(20, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(EstimateNormals(one_place)[0], Eigen::Vector3d::Zero());
  EXPECT_TRUE(EstimateNormals({}).empty());
}

TEST(EnsureNormals, KeepsGivenOnesAndSaysWhetherTheSignIsKnown) {
  PointCloud given = MakeGridMesh(3, 3);
  given.normals.assign(9, Eigen::Vector3d::UnitX());
  EnsureNormals(&given);
  EXPECT_EQ(given.normals[0], Eigen::Vector3d::UnitX());

  PointCloud mesh = MakeGridMesh(3, 3);
  EnsureNormals(&mesh);
  EXPECT_TRUE(mesh.normals_oriented);
  EXPECT_EQ(mesh.normals[4], Eigen::Vector3d::UnitZ());

  PointCloud bare = MakeGridMesh(3, 3);
  bare.triangles.clear();
  EnsureNormals(&bare);
  EXPECT_FALSE(bare.normals_oriented);
  EXPECT_NEAR(std::abs(bare.normals[4].z()), 1.0, 1e-14);
}

}  // namespace
}  // namespace ceres_ed
