#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/orientation.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

void Reverse(int triangle, PointCloud* mesh) {
  std::swap(mesh->triangles[triangle][1], mesh->triangles[triangle][2]);
}

std::vector<int> Against(const PointCloud& mesh) {
  return TrianglesAgainstNeighbors(mesh, BuildTopology(mesh));
}

TEST(TrianglesAgainstNeighbors, AreNoneOnAConsistentMesh) {
  EXPECT_TRUE(Against(MakeSphereMesh(2)).empty());
  EXPECT_TRUE(Against(MakeGridMesh(5, 4)).empty());
}

TEST(TrianglesAgainstNeighbors, AreThoseThatWereReversed) {
  PointCloud mesh = MakeGridMesh(6, 6);
  const std::vector<int> reversed = {3, 4, 17, 40};
  for (const int t : reversed) Reverse(t, &mesh);
  EXPECT_EQ(Against(mesh), reversed);
}

TEST(TrianglesAgainstNeighbors, AreFoundWhereTrianglesShareNoPoints) {
  std::vector<int> source;
  PointCloud mesh = Unweld(MakeSphereMesh(2), &source);
  Reverse(7, &mesh);
  EXPECT_EQ(Against(mesh), std::vector<int>{7});
}

TEST(TrianglesAgainstNeighbors, DoNotCountATriangleThatIsListedTwice) {
  PointCloud mesh = MakeGridMesh(4, 4);
  mesh.triangles.push_back(mesh.triangles.front());
  EXPECT_TRUE(Against(mesh).empty());
}

TEST(TrianglesAgainstNeighbors, EndOnAMoebiusStrip) {
  constexpr int kColumns = 12;
  PointCloud strip;
  for (int c = 0; c < kColumns; ++c) {
    const double turn = 2.0 * M_PI * c / kColumns;
    for (const double side : {-0.3, 0.3}) {
      const double radius = 1.0 + side * std::cos(0.5 * turn);
      strip.points.emplace_back(
          radius * std::cos(turn), radius * std::sin(turn), side * std::sin(0.5 * turn));
    }
  }
  for (int c = 0; c < kColumns; ++c) {
    const bool is_last = c + 1 == kColumns;
    const int a = 2 * c, b = 2 * c + 1;
    const int d = is_last ? 1 : a + 2, e = is_last ? 0 : b + 2;
    strip.triangles.push_back({a, b, e});
    strip.triangles.push_back({a, e, d});
  }
  EXPECT_LT(Against(strip).size(), strip.triangles.size());
}

TEST(ShareOfNormalsAgainstTriangles, IsThePartOfReversedNormals) {
  PointCloud mesh = MakeSphereMesh(3);
  mesh.normals = ComputeVertexNormals(mesh);
  EXPECT_EQ(ShareOfNormalsAgainstTriangles(mesh), 0.0);
  for (std::size_t p = 0; p < mesh.size(); p += 4) mesh.normals[p] = -mesh.normals[p];
  EXPECT_NEAR(ShareOfNormalsAgainstTriangles(mesh), 0.25, 0.01);
}

TEST(ShareOfContradictingNormals, IsHalfForRandomSignsAndSmallForConsistentOnes) {
  PointCloud cloud = MakeSphereMesh(4);
  cloud.normals = ComputeVertexNormals(cloud);
  cloud.triangles.clear();
  EXPECT_EQ(ShareOfContradictingNormals(cloud), 0.0);
  std::mt19937 random(1);
  for (Eigen::Vector3d& normal : cloud.normals) {
    if (random() % 2 == 0) normal = -normal;
  }
  EXPECT_NEAR(ShareOfContradictingNormals(cloud), 0.5, 0.05);
  ChooseNormalSigns(cloud.points, &cloud.normals);
  EXPECT_EQ(ShareOfContradictingNormals(cloud), 0.0);
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    EXPECT_GT(cloud.normals[p].dot(cloud.points[p]), 0.0);
  }
}

TEST(EnclosedVolume, IsThatOfTheBallWithTheSignOfItsWinding) {
  PointCloud mesh = MakeSphereMesh(5);
  const double ball = 4.0 / 3.0 * M_PI;
  EXPECT_NEAR(EnclosedVolume(mesh, BuildTopology(mesh)), ball, 0.01);
  ReverseOrientation(&mesh);
  EXPECT_NEAR(EnclosedVolume(mesh, BuildTopology(mesh)), -ball, 0.01);
}

TEST(EnclosedVolume, IsZeroForAnOpenSheet) {
  const PointCloud mesh = MakeGridMesh(9, 9);
  EXPECT_EQ(EnclosedVolume(mesh, BuildTopology(mesh)), 0.0);
}

}  // namespace
}  // namespace ceres_ed
