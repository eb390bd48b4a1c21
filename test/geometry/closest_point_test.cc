#include <ceres_ed/geometry/closest_point.h>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

double DistanceTo(const Eigen::Vector3d& query,
                  const Eigen::Vector3d& barycentric,
                  const Eigen::Vector3d& a,
                  const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c) {
  return (query - (barycentric[0] * a + barycentric[1] * b + barycentric[2] * c)).norm();
}

TEST(ClosestPointOnTriangle, NoPointOfAFineLatticeIsNearer) {
  const std::vector<Eigen::Vector3d> corners = RandomPoints(300, 41);
  const std::vector<Eigen::Vector3d> queries = RandomPoints(100, 42, 2.0);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d &a = corners[3 * i], &b = corners[3 * i + 1], &c = corners[3 * i + 2];
    const Eigen::Vector3d found = ClosestPointOnTriangle(queries[i], a, b, c);
    EXPECT_GE(found.minCoeff(), 0.0);
    EXPECT_NEAR(found.sum(), 1.0, 1e-14);
    const double distance = DistanceTo(queries[i], found, a, b, c);
    double lattice = std::numeric_limits<double>::infinity();
    const int steps = 60;
    for (int u = 0; u <= steps; ++u) {
      for (int v = 0; u + v <= steps; ++v) {
        const Eigen::Vector3d weights = Eigen::Vector3d(u, v, steps - u - v) / steps;
        lattice = std::min(lattice, DistanceTo(queries[i], weights, a, b, c));
      }
    }
    EXPECT_LE(distance, lattice + 1e-12);
    // No lattice point is farther from the best one than two steps of the longest edge (3.5).
    EXPECT_GE(distance, lattice - 2.0 * 3.5 / steps);
  }
}

TEST(ClosestPointOnTriangle, TellsCornersEdgesAndInside) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(ClosestPointOnTriangle({-1, -1, 3}, a, b, c), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(ClosestPointOnTriangle({3, 0, 1}, a, b, c), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(ClosestPointOnTriangle({0.25, -1, 0}, a, b, c), Eigen::Vector3d(0.75, 0.25, 0));
  EXPECT_EQ(ClosestPointOnTriangle({1, 1, 0}, a, b, c), Eigen::Vector3d(0, 0.5, 0.5));
  EXPECT_EQ(ClosestPointOnTriangle({0.25, 0.25, 9}, a, b, c), Eigen::Vector3d(0.5, 0.25, 0.25));
}

TEST(ClosestPointOnTriangle, TakesAFlatTriangleForItsLongestEdge) {
  const Eigen::Vector3d a(0, 0, 0), b(1, 0, 0), c(4, 0, 0);
  const Eigen::Vector3d on_line = ClosestPointOnTriangle({3, 1, 0}, a, b, c);
  EXPECT_NEAR(DistanceTo({3, 1, 0}, on_line, a, b, c), 1.0, 1e-15);
  const Eigen::Vector3d at_point = ClosestPointOnTriangle({3, 1, 0}, a, a, a);
  EXPECT_NEAR(at_point.sum(), 1.0, 1e-15);
}

TEST(SurfaceIndex, EqualsBruteForceOverAllTriangles) {
  PointCloud mesh = MakeSphereMesh(3);
  Jitter(0.03, 43, &mesh);
  // Large triangles next to small ones: the vertices of the large ones are far from points inside
  // them.
  mesh = Append(mesh, MakeGridMesh(2, 2, 8.0), {-4, -4, 1.5});
  const SurfaceIndex index(mesh);
  for (const Eigen::Vector3d& query : RandomPoints(300, 44, 2.0)) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d &pa = mesh.points[a], &pb = mesh.points[b], &pc = mesh.points[c];
      best =
          std::min(best, DistanceTo(query, ClosestPointOnTriangle(query, pa, pb, pc), pa, pb, pc));
    }
    const SurfaceHit hit = index.Closest(query);
    ASSERT_TRUE(hit.found());
    EXPECT_NEAR(std::sqrt(hit.squared_distance), best, 1e-14);
    EXPECT_NEAR((query - hit.position).norm(), best, 1e-14);
    const auto& [a, b, c] = mesh.triangles[hit.triangle];
    EXPECT_NEAR(DistanceTo(query, hit.barycentric, mesh.points[a], mesh.points[b], mesh.points[c]),
                best,
                1e-14);
    for (const int corner : {a, b, c}) {
      EXPECT_LE((hit.position - mesh.points[hit.nearest_vertex]).norm(),
                (hit.position - mesh.points[corner]).norm());
    }
  }
}

// Thin triangles of all proportions, far from the origin, with queries from the surface to far
// away: the cases in which bounds could be wrong.
TEST(SurfaceIndex, EqualsBruteForceOnSliversNearAndFar) {
  PointCloud mesh;
  const std::vector<Eigen::Vector3d> random = RandomPoints(3 * 80, 45);
  const Eigen::Vector3d offset(300.0, -200.0, 100.0);
  for (int i = 0; i < 80; ++i) {
    const double width = std::pow(10.0, -i % 16);
    const Eigen::Vector3d a = random[3 * i] + offset, ab = random[3 * i + 1];
    const Eigen::Vector3d c = a + 0.3 * ab + width * random[3 * i + 2];
    const int first = static_cast<int>(mesh.size());
    for (const Eigen::Vector3d& point : {a, Eigen::Vector3d(a + ab), c})
      mesh.points.push_back(point);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const SurfaceIndex index(mesh);
  std::vector<Eigen::Vector3d> queries;
  for (const Eigen::Vector3d& away : RandomPoints(200, 46)) {
    const int i = static_cast<int>(queries.size()) / 2 % 80;
    const Eigen::Vector3d on = (mesh.points[3 * i] + mesh.points[3 * i + 1]) / 2.0;
    queries.push_back(on + 1e-7 * away);
    queries.push_back(offset + 30.0 * away);
  }
  for (const Eigen::Vector3d& query : queries) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles) {
      const Eigen::Vector3d &pa = mesh.points[a], &pb = mesh.points[b], &pc = mesh.points[c];
      const Eigen::Vector3d w = ClosestPointOnTriangle(query, pa, pb, pc);
      best = std::min(best, (query - (w[0] * pa + w[1] * pb + w[2] * pc)).squaredNorm());
    }
    EXPECT_EQ(index.Closest(query).squared_distance, best);
  }
}

TEST(SurfaceIndex, AHintChangesNothing) {
  PointCloud mesh = MakeSphereMesh(3);
  const int last = static_cast<int>(mesh.triangles.size()) - 1;
  PointCloud bare;
  bare.points = mesh.points;
  for (const PointCloud* cloud : {&mesh, &bare}) {
    const SurfaceIndex index(*cloud);
    // The vertices are queries, too: each is equally near to all triangles around it.
    std::vector<Eigen::Vector3d> queries = RandomPoints(100, 47, 1.5);
    queries.insert(queries.end(), mesh.points.begin(), mesh.points.begin() + 100);
    for (const Eigen::Vector3d& query : queries) {
      const SurfaceHit expected = index.Closest(query, 0.4);
      for (const int hint : {0, cloud == &mesh ? last : 7, expected.place()}) {
        const SurfaceHit hit = index.Closest(query, 0.4, hint);
        EXPECT_EQ(hit.place(), expected.place());
        EXPECT_EQ(hit.position, expected.position);
        EXPECT_EQ(hit.squared_distance, expected.squared_distance);
      }
    }
  }
}

TEST(SurfaceIndex, AMaximumDistanceHidesWhatIsFarther) {
  const PointCloud mesh = MakeGridMesh(5, 5);
  const SurfaceIndex index(mesh);
  EXPECT_TRUE(index.Closest({2.2, 2.3, 1.0}, 1.0).found());
  EXPECT_FALSE(index.Closest({2.2, 2.3, 1.0}, 0.999).found());
  EXPECT_FALSE(index.Closest({2.2, 2.3, 1.0}, -1.0).found());
  EXPECT_FALSE(index.Closest({std::nan(""), 2.3, 1.0}).found());
}

TEST(SurfaceIndex, TheFirstTriangleWinsATie) {
  const PointCloud mesh = MakeGridMesh(9, 9);
  const SurfaceIndex index(mesh);
  for (int p = 0; p < 81; ++p) {
    const SurfaceHit hit = index.Closest(mesh.points[p] + Eigen::Vector3d(0, 0, 0.5));
    EXPECT_EQ(hit.nearest_vertex, p);
    for (int t = 0; t < hit.triangle; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      EXPECT_TRUE(a != p && b != p && c != p) << "point " << p << " triangle " << t;
    }
  }
}

TEST(SurfaceIndex, SaysWhenTheHitIsOnTheBorder) {
  const PointCloud mesh = MakeGridMesh(4, 4);
  const SurfaceIndex index(mesh);
  EXPECT_TRUE(index.Closest({1.5, -2.0, 0.5}).on_border);
  EXPECT_TRUE(index.Closest({-1.0, -1.0, 0.0}).on_border);
  EXPECT_TRUE(index.Closest({0.0, 1.0, 1.0}).on_border);
  EXPECT_FALSE(index.Closest({1.5, 1.2, 0.5}).on_border);
  EXPECT_FALSE(index.Closest({1.0, 1.0, 0.5}).on_border);
  EXPECT_FALSE(index.Closest({0.4, 0.2, 0.5}).on_border);
}

TEST(SurfaceIndex, LeavesOutVerticesWithoutATriangle) {
  PointCloud mesh = MakeGridMesh(3, 3);
  mesh.points.emplace_back(1, 1, 5);
  mesh.triangles.push_back({9, 9, 0});
  const SurfaceHit hit = SurfaceIndex(mesh).Closest({1, 1, 5});
  EXPECT_DOUBLE_EQ(hit.squared_distance, 25.0);
  EXPECT_EQ(hit.nearest_vertex, 4);
}

TEST(SurfaceIndex, OnBarePointsIsTheNearestPoint) {
  PointCloud cloud;
  cloud.points = {{0, 0, 0}, {1, 0, 0}};
  const SurfaceHit hit = SurfaceIndex(cloud).Closest({0.9, 0, 0});
  EXPECT_EQ(hit.nearest_vertex, 1);
  EXPECT_EQ(hit.triangle, -1);
  EXPECT_EQ(hit.position, cloud.points[1]);
  EXPECT_FALSE(SurfaceIndex(PointCloud()).Closest({0, 0, 0}).found());
}

}  // namespace
}  // namespace ceres_ed
