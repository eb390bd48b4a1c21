#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/geometry/welded_mesh.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

WeldedMesh Build(const PointCloud& cloud) { return BuildWeldedMesh(cloud, BuildTopology(cloud)); }

std::vector<Eigen::Vector3d> AtVertices(const PointCloud& cloud, const WeldedMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  for (const int point : mesh.point_of_vertex) points.push_back(cloud.points[point]);
  return points;
}

TEST(BuildWeldedMesh, HasTheEdgesOfTheTrianglesEachOnce) {
  const PointCloud grid = MakeGridMesh(4, 5);
  const WeldedMesh mesh = Build(grid);
  EXPECT_EQ(mesh.num_vertices(), 20);
  EXPECT_EQ(mesh.triangles, grid.triangles);
  std::set<std::pair<int, int>> expected;
  for (const auto& t : grid.triangles) {
    for (int k = 0; k < 3; ++k) expected.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }
  EXPECT_EQ(mesh.edges.size(), expected.size());
  EXPECT_EQ((std::set<std::pair<int, int>>(mesh.edges.begin(), mesh.edges.end())), expected);
}

TEST(BuildWeldedMesh, KnowsTheTrianglesAroundEachVertex) {
  const WeldedMesh mesh = Build(MakeSphereMesh(1));
  for (int v = 0; v < mesh.num_vertices(); ++v) {
    std::vector<int> expected;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& corners = mesh.triangles[t];
      if (std::count(corners.begin(), corners.end(), v) > 0) {
        expected.push_back(static_cast<int>(t));
      }
    }
    EXPECT_EQ(std::vector<int>(mesh.around.begin() + mesh.around_offsets[v],
                               mesh.around.begin() + mesh.around_offsets[v + 1]),
              expected)
        << v;
  }
}

TEST(BuildWeldedMesh, JoinsThePointsAtOnePosition) {
  const PointCloud grid = MakeGridMesh(4, 5);
  std::vector<int> origin;
  const PointCloud soup = Unweld(grid, &origin);
  const WeldedMesh mesh = Build(soup);
  ASSERT_EQ(mesh.num_vertices(), 20);
  EXPECT_EQ(mesh.triangles.size(), grid.triangles.size());
  EXPECT_EQ(mesh.edges.size(), Build(grid).edges.size());
  for (std::size_t p = 0; p < soup.size(); ++p) {
    const int representative = mesh.point_of_vertex[mesh.vertex_of_point[p]];
    EXPECT_EQ(origin[representative], origin[p]);
    EXPECT_LE(representative, static_cast<int>(p));
  }
}

TEST(BuildWeldedMesh, LeavesOutATriangleOfOnePositionTwiceAndKeepsIsolatedVertices) {
  PointCloud cloud = MakeGridMesh(2, 2);
  cloud.points.push_back(cloud.points[0]);
  cloud.points.emplace_back(9.0, 9.0, 9.0);
  cloud.triangles.push_back({0, 1, 4});
  const WeldedMesh mesh = Build(cloud);
  EXPECT_EQ(mesh.num_vertices(), 5);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  const int isolated = mesh.vertex_of_point[5];
  EXPECT_EQ(mesh.around_offsets[isolated], mesh.around_offsets[isolated + 1]);
  for (const auto& [a, b] : mesh.edges) {
    EXPECT_NE(a, isolated);
    EXPECT_NE(b, isolated);
  }
}

TEST(BuildWeldedMesh, TiesBarePointsToTheirNearestOnes) {
  PointCloud cloud;
  cloud.points = RandomPoints(60, 3);
  const WeldedMesh mesh = Build(cloud);
  // Brute force: the six nearest points of each point, in either direction.
  std::set<std::pair<int, int>> expected;
  for (int p = 0; p < 60; ++p) {
    std::vector<std::pair<double, int>> others;
    for (int q = 0; q < 60; ++q) {
      if (q != p) others.emplace_back((cloud.points[p] - cloud.points[q]).norm(), q);
    }
    std::sort(others.begin(), others.end());
    for (int i = 0; i < 6; ++i) expected.insert(std::minmax(p, others[i].second));
  }
  EXPECT_EQ((std::set<std::pair<int, int>>(mesh.edges.begin(), mesh.edges.end())), expected);
  EXPECT_EQ(mesh.edges.size(), expected.size());
}

TEST(SquaredLaplacian, IsTheSquareOfTheUniformOne) {
  PointCloud cloud = MakeGridMesh(4, 5);
  cloud.points.emplace_back(9.0, 9.0, 9.0);
  const WeldedMesh mesh = Build(cloud);
  const int size = mesh.num_vertices();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(size, size);
  for (const auto& [a, b] : mesh.edges) {
    L(a, a) += 1.0;
    L(b, b) += 1.0;
    L(a, b) = L(b, a) = -1.0;
  }
  // The row of an isolated vertex is zero, so any degree except 0 will do.
  const Eigen::VectorXd degrees = L.diagonal().cwiseMax(1.0);
  const Eigen::MatrixXd expected = L * degrees.cwiseInverse().asDiagonal() * L;
  const Eigen::SparseMatrix<double> found = SquaredLaplacian(mesh);
  const Eigen::MatrixXd lower = expected.triangularView<Eigen::Lower>();
  EXPECT_LT((Eigen::MatrixXd(found) - lower).norm(), 1e-13);
  // Solvers add to the diagonal, so it must be the first entry of every column, even of an empty
  // one.
  for (int v = 0; v < size; ++v) {
    EXPECT_EQ(found.innerIndexPtr()[found.outerIndexPtr()[v]], v);
  }
}

TEST(WeldedNormals, AreThoseOfTheSphereAndZeroForBarePoints) {
  PointCloud sphere = MakeSphereMesh(3);
  const WeldedMesh mesh = Build(sphere);
  const std::vector<Eigen::Vector3d> points = AtVertices(sphere, mesh);
  const std::vector<Eigen::Vector3d> normals = WeldedNormals(mesh, points);
  // An edge is 0.14 long. Where the triangles around a vertex are symmetric, its normal is exact;
  // elsewhere the error is of second order in that length.
  for (std::size_t v = 0; v < points.size(); ++v) {
    EXPECT_LT((normals[v] - points[v]).norm(), 0.02) << v;
  }
  sphere.triangles.clear();
  for (const Eigen::Vector3d& normal : WeldedNormals(Build(sphere), points)) {
    EXPECT_EQ(normal, Eigen::Vector3d::Zero());
  }
}

}  // namespace
}  // namespace ceres_ed
