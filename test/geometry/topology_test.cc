#include <ceres_ed/geometry/topology.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

TEST(Topology, GridHasItsEdgesAndBorder) {
  const int columns = 5, rows = 4;
  const PointCloud mesh = MakeGridMesh(columns, rows, 0.5);
  const SurfaceTopology topology = BuildTopology(mesh);
  // Edges along rows, along columns, and one diagonal in each cell. Each edge is listed at both
  // ends.
  EXPECT_EQ(topology.edges.size(), 2u * (4 * 4 + 5 * 3 + 4 * 3));
  for (int p = 0; p < topology.num_points(); ++p) {
    const int column = p % columns, row = p / columns;
    const bool on_rim = column == 0 || column == columns - 1 || row == 0 || row == rows - 1;
    EXPECT_EQ(topology.is_border[p] != 0, on_rim) << "point " << p;
    EXPECT_EQ(topology.is_isolated[p], 0);
    for (const SurfaceLink& edge : topology.Edges(p)) {
      EXPECT_DOUBLE_EQ(edge.length, (mesh.points[p] - mesh.points[edge.to]).norm());
    }
  }
  EXPECT_TRUE(topology.IsBorderEdge(0, 1));
  EXPECT_FALSE(topology.IsBorderEdge(0, columns + 1));
  EXPECT_FALSE(topology.IsBorderEdge(0, 2));
  EXPECT_EQ(topology.num_components(), 1);
  EXPECT_EQ(topology.component_sizes[0], columns * rows);
}

TEST(Topology, AClosedMeshHasNoBorder) {
  const SurfaceTopology topology = BuildTopology(MakeSphereMesh(2));
  EXPECT_EQ(std::count(topology.is_border.begin(), topology.is_border.end(), 1), 0);
  // Euler: 162 vertices, 480 edges, 320 faces.
  EXPECT_EQ(topology.edges.size(), 2u * 480);
}

TEST(Topology, PathsGoStraightAcrossTwoUnfoldedTriangles) {
  // Two right triangles at the edge (0, 1), folded by 90 degrees. Unfolded, their corners are 2
  // apart.
  PointCloud mesh;
  mesh.points = {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
  const SurfaceTopology topology = BuildTopology(mesh);
  ASSERT_EQ(topology.Paths(2).size(), 3);
  const SurfaceLink shortcut = *(topology.Paths(2).end() - 1);
  EXPECT_EQ(shortcut.to, 3);
  EXPECT_NEAR(shortcut.length, 2.0, 1e-15);
}

TEST(Topology, PathsDoNotCutCornersOfTheSurface) {
  // In the plane, the straight line between the tips 2 and 3 does not cross the edge (0, 1).
  PointCloud mesh;
  mesh.points = {{0, 0, 0}, {0, 1, 0}, {1, 3, 0}, {-1, 3, 0}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
  EXPECT_EQ(BuildTopology(mesh).Paths(2).size(), 2);
}

TEST(Topology, AnUnweldedMeshHasTheLinksOfTheWeldedOne) {
  PointCloud mesh = MakeSphereMesh(2);
  Jitter(0.02, 5, &mesh);
  std::vector<int> source;
  const PointCloud soup = Unweld(mesh, &source);
  const SurfaceTopology welded = BuildTopology(mesh);
  const SurfaceTopology unwelded = BuildTopology(soup);
  ASSERT_EQ(unwelded.walk_order.size(), welded.walk_order.size());
  for (std::size_t i = 0; i < welded.walk_order.size(); ++i) {
    EXPECT_EQ(source[unwelded.walk_order[i]], welded.walk_order[i]);
  }
  for (int p = 0; p < unwelded.num_points(); ++p) {
    const int representative = unwelded.representative[p];
    EXPECT_EQ(source[representative], source[p]);
    EXPECT_EQ(unwelded.is_border[p], welded.is_border[source[p]]);
    if (representative != p) {
      EXPECT_EQ(unwelded.Paths(p).size(), 0);
      continue;
    }
    std::multiset<std::pair<int, double>> expected, found;
    for (const SurfaceLink& link : welded.Paths(source[p])) expected.insert({link.to, link.length});
    for (const SurfaceLink& link : unwelded.Paths(p)) found.insert({source[link.to], link.length});
    EXPECT_EQ(found, expected) << "point " << p;
  }
  EXPECT_EQ(unwelded.component_sizes, welded.component_sizes);
}

TEST(Topology, ComponentsAndIsolatedPointsAreToldApart) {
  PointCloud mesh = Append(MakeGridMesh(3, 3), MakeGridMesh(2, 2), {10, 0, 0});
  mesh.points.emplace_back(50, 0, 0);
  mesh.points.emplace_back(60, 0, 0);
  const SurfaceTopology topology = BuildTopology(mesh);
  EXPECT_EQ(topology.component_sizes, (std::vector<int>{9, 4, 1, 1}));
  EXPECT_EQ(topology.component[8], 0);
  EXPECT_EQ(topology.component[9], 1);
  EXPECT_EQ(topology.component[14], 3);
  EXPECT_EQ(topology.is_isolated[8], 0);
  EXPECT_EQ(topology.is_isolated[13], 1);
}

TEST(Topology, ABareCloudIsAllIsolated) {
  PointCloud cloud;
  cloud.points = RandomPoints(10, 6);
  const SurfaceTopology topology = BuildTopology(cloud);
  EXPECT_FALSE(topology.HasSurface());
  EXPECT_EQ(std::count(topology.is_isolated.begin(), topology.is_isolated.end(), 1), 10);
  EXPECT_EQ(topology.num_components(), 10);
  EXPECT_EQ(MeanEdgeLength(topology), 0.0);
}

TEST(Topology, TrianglesWithoutThreePositionsAndRepeatedOnesDoNotCount) {
  PointCloud mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 2}, {2, 1, 0}, {0, 3, 4}, {1, 1, 2}};
  const SurfaceTopology topology = BuildTopology(mesh);
  EXPECT_EQ(topology.edges.size(), 6u);
  EXPECT_TRUE(topology.IsBorderEdge(0, 1));
  EXPECT_EQ(topology.is_isolated[3], 1);
}

TEST(WeldPoints, JoinsPositionsThatAreEqualUpToRounding) {
  const double next = std::nextafter(1.0, 2.0);
  std::vector<int> order;
  EXPECT_EQ(WeldPoints({{1, 0, 0}, {next, 0, 1e-17}, {1, -0.0, -1e-17}, {0, 7, 0}, {1, 0, 1e-10}},
                       &order),
            (std::vector<int>{0, 0, 0, 3, 4}));
  EXPECT_EQ(order, (std::vector<int>{3, 0, 4}));
}

TEST(WeldPoints, JoinsEqualPositionsOfAnySize) {
  for (const double size : {1e-320, 1e-200, 1e-3, 1e3, 1e200}) {
    const std::vector<Eigen::Vector3d> points = {
        {size, 0, 0}, {0, size, 0}, {size, 0, 0}, {0, 0, size}};
    EXPECT_EQ(WeldPoints(points), (std::vector<int>{0, 1, 0, 3})) << size;
  }
  EXPECT_EQ(WeldPoints({{1, 2, 3}, {1, 2, 3}}), (std::vector<int>{0, 0}));
}

// A seam that is closed in the file must be closed wherever the surface is, so that graphs and
// warps bind points to the same nodes in every frame.
TEST(WeldPoints, JoinsASeamThatWasComputedTwice) {
  std::vector<Eigen::Vector3d> ring;
  for (int i = 0; i <= 24; ++i) {
    const double angle = 2.0 * M_PI * i / 24;
    ring.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  ASSERT_NE(ring.front(), ring.back());
  EXPECT_EQ(WeldPoints(ring).back(), 0);
  for (Eigen::Vector3d& point : ring) point += Eigen::Vector3d(3.0, -2.0, 0.5);
  EXPECT_EQ(WeldPoints(ring).back(), 0);
}

TEST(TopologyDeathTest, ATriangleIndexOutOfRangeIsAProgrammersMistake) {
  PointCloud mesh = MakeGridMesh(2, 2);
  mesh.triangles.push_back({0, 1, 4});
  EXPECT_DEATH(BuildTopology(mesh), "triangle corner 4 of 4 points");
}

}  // namespace
}  // namespace ceres_ed
