#include <ceres_ed/geometry/surface_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// Returns all distances along the paths by the algorithm of Floyd and Warshall.
std::vector<std::vector<double>> AllDistances(const SurfaceTopology& topology) {
  const int n = topology.num_points();
  std::vector<std::vector<double>> d(
      n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
  for (int i = 0; i < n; ++i) {
    d[i][i] = 0.0;
    for (const SurfaceLink& link : topology.Paths(i)) {
      d[i][link.to] = std::min(d[i][link.to], link.length);
    }
  }
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
    }
  }
  return d;
}

PointCloud BumpyMesh() {
  PointCloud mesh = MakeSphereMesh(2);
  Jitter(0.05, 7, &mesh);
  return mesh;
}

// Returns the distance of every point from one point.
std::vector<double> DistancesFrom(int point, const SurfaceTopology& topology) {
  return NearestSeedsAlongSurface(topology, {point}, 1).distances;
}

TEST(NearestSeeds, OfOneSeedEqualFloydWarshall) {
  const SurfaceTopology topology = BuildTopology(BumpyMesh());
  const auto expected = AllDistances(topology);
  for (const int seed : {0, 17, 101}) {
    const std::vector<double> distances = DistancesFrom(seed, topology);
    for (int p = 0; p < topology.num_points(); ++p) {
      EXPECT_NEAR(distances[p], expected[seed][p], 1e-13);
    }
  }
}

TEST(NearestSeeds, HaveDistancesThatAreSymmetricUpToRounding) {
  const SurfaceTopology topology = BuildTopology(BumpyMesh());
  const std::vector<double> from_3 = DistancesFrom(3, topology);
  for (int p = 0; p < topology.num_points(); ++p) {
    EXPECT_NEAR(DistancesFrom(p, topology)[3], from_3[p], 1e-13);
  }
}

TEST(NearestSeeds, StopAtTheEndOfAComponent) {
  const PointCloud mesh = Append(MakeGridMesh(10, 1), MakeGridMesh(10, 2), {0, 100, 0});
  const SurfaceTopology topology = BuildTopology(mesh);
  const std::vector<double> distances = DistancesFrom(10, topology);
  EXPECT_DOUBLE_EQ(distances[14], 4.0);
  EXPECT_TRUE(std::isinf(distances[0]));
}

TEST(NearestSeeds, HaveDistancesThatOnAPlaneAreAtMostAFewPercentTooLong) {
  const PointCloud mesh = MakeGridMesh(41, 41);
  const int center = 20 * 41 + 20;
  const std::vector<double> distances = DistancesFrom(center, BuildTopology(mesh));
  double worst = 0.0;
  for (std::size_t p = 0; p < mesh.size(); ++p) {
    const double exact = (mesh.points[p] - mesh.points[center]).norm();
    EXPECT_GE(distances[p], exact - 1e-12);
    if (exact > 0.0) worst = std::max(worst, distances[p] / exact - 1.0);
  }
  // Paths along rows and diagonals only are at most 1 / cos(22.5 degrees) - 1 = 8.2 % too long.
  EXPECT_LT(worst, 0.083);
}

TEST(NearestSeeds, HaveDistancesThatOnASphereAreWithinFivePercentOfGreatCircles) {
  const PointCloud mesh = MakeSphereMesh(4);
  const std::vector<double> distances = DistancesFrom(0, BuildTopology(mesh));
  double worst = 0.0, mean = 0.0;
  for (std::size_t p = 1; p < mesh.size(); ++p) {
    const double exact =
        2.0 * std::asin(std::min(1.0, 0.5 * (mesh.points[p] - mesh.points[0]).norm()));
    const double error = distances[p] / exact - 1.0;
    // Chords of edges are a little shorter than arcs.
    EXPECT_GT(error, -0.002);
    worst = std::max(worst, error);
    mean += error / static_cast<double>(mesh.size());
  }
  // Twelve directions 30 degrees apart on equilateral triangles would give 3.5 %. The projection to
  // the sphere stretches some triangles.
  EXPECT_LT(worst, 0.05);
  EXPECT_LT(mean, 0.025);
}

TEST(NearestSeeds, EqualTheSingleSeedDistancesSorted) {
  const SurfaceTopology topology = BuildTopology(BumpyMesh());
  const std::vector<int> seeds = {5, 150, 33, 80, 12, 99, 61, 7};
  const int k = 5;
  const NearestSeeds nearest = NearestSeedsAlongSurface(topology, seeds, k);
  std::vector<std::vector<double>> single;
  for (const int seed : seeds) single.push_back(DistancesFrom(seed, topology));
  for (int p = 0; p < topology.num_points(); ++p) {
    std::vector<std::pair<double, int>> expected;
    for (int s = 0; s < static_cast<int>(seeds.size()); ++s) expected.push_back({single[s][p], s});
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(nearest.Count(p), k);
    for (int i = 0; i < k; ++i) {
      EXPECT_EQ(nearest.SeedsOf(p)[i], expected[i].second);
      EXPECT_EQ(nearest.DistancesOf(p)[i], expected[i].first);
    }
  }
}

TEST(NearestSeeds, TiesGoToTheLowestSeedAndASharedPointHasThemAll) {
  const SurfaceTopology topology = BuildTopology(MakeGridMesh(5, 2));
  const NearestSeeds nearest = NearestSeedsAlongSurface(topology, {4, 0, 4, 0}, 3);
  EXPECT_EQ(std::vector<int>(nearest.SeedsOf(2), nearest.SeedsOf(2) + 3),
            (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(std::vector<int>(nearest.SeedsOf(0), nearest.SeedsOf(0) + 3),
            (std::vector<int>{1, 3, 0}));
  EXPECT_EQ(nearest.DistancesOf(0)[1], 0.0);
}

TEST(NearestSeeds, OffsetsAddToTheDistance) {
  const SurfaceTopology topology = BuildTopology(MakeGridMesh(5, 2));
  const NearestSeeds nearest = NearestSeedsAlongSurface(topology, {0, 4}, 2, {3.5, 0.25});
  EXPECT_EQ(nearest.SeedsOf(0)[0], 0);
  EXPECT_DOUBLE_EQ(nearest.DistancesOf(0)[0], 3.5);
  EXPECT_DOUBLE_EQ(nearest.DistancesOf(0)[1], 4.25);
  EXPECT_EQ(nearest.SeedsOf(1)[0], 1);
}

TEST(NearestSeeds, DoNotCrossFromOneComponentToAnother) {
  const PointCloud mesh = Append(MakeGridMesh(4, 4), MakeGridMesh(4, 4), {0, 0, 0.01});
  const NearestSeeds nearest = NearestSeedsAlongSurface(BuildTopology(mesh), {0, 15, 20}, 3);
  EXPECT_EQ(nearest.Count(5), 2);
  EXPECT_EQ(nearest.Count(21), 1);
  EXPECT_EQ(nearest.SeedsOf(21)[0], 2);
  EXPECT_TRUE(std::isinf(nearest.DistancesOf(21)[1]));
}

TEST(NearestSeeds, OfAnUnweldedMeshAreThoseOfTheWeldedOne) {
  const PointCloud mesh = BumpyMesh();
  std::vector<int> source;
  const PointCloud soup = Unweld(mesh, &source);
  const std::vector<int> seeds = {5, 150, 33, 80, 12, 99};
  std::vector<int> soup_seeds;
  for (const int seed : seeds) {
    // Use the last copy, so that a seed that is not a representative is tried, too.
    const auto last = std::find(source.rbegin(), source.rend(), seed);
    soup_seeds.push_back(static_cast<int>(source.rend() - last) - 1);
  }
  const NearestSeeds welded = NearestSeedsAlongSurface(BuildTopology(mesh), seeds, 4);
  const NearestSeeds unwelded = NearestSeedsAlongSurface(BuildTopology(soup), soup_seeds, 4);
  for (std::size_t p = 0; p < soup.size(); ++p) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(unwelded.SeedsOf(p)[i], welded.SeedsOf(source[p])[i]);
      EXPECT_EQ(unwelded.DistancesOf(p)[i], welded.DistancesOf(source[p])[i]);
    }
  }
}

}  // namespace
}  // namespace ceres_ed
