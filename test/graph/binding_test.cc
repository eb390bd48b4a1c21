#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/graph/binding.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> Weights(const std::vector<double>& distances, int neighbors) {
  std::vector<double> weights(neighbors);
  weights.resize(ComputeWeights(
      distances.data(), static_cast<int>(distances.size()), neighbors, weights.data()));
  return weights;
}

DeformationGraph GraphOn(const PointCloud& cloud, const std::vector<int>& node_points) {
  DeformationGraph graph;
  for (const int point : node_points) graph.AddNode(cloud.points[point]);
  return graph;
}

void ExpectSameToTheBit(const Skinning& a, const Skinning& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t p = 0; p < a.size(); ++p) {
    ASSERT_EQ(a[p].size, b[p].size) << "point " << p;
    for (int i = 0; i < a[p].size; ++i) {
      EXPECT_EQ(a[p].nodes[i], b[p].nodes[i]) << "point " << p;
      EXPECT_EQ(a[p].weights[i], b[p].weights[i]) << "point " << p;
    }
  }
}

TEST(ComputeWeights, FollowsEquation2) {
  // 1 - d / 5 is 0.8, 0.6, 0.4 and 0.2; the sum is 2.
  EXPECT_THAT(Weights({1, 2, 3, 4, 5}, 4),
              ElementsAre(DoubleNear(0.4, 1e-15),
                          DoubleNear(0.3, 1e-15),
                          DoubleNear(0.2, 1e-15),
                          DoubleNear(0.1, 1e-15)));
}

TEST(ComputeWeights, IgnoresNodesBeyondTheLastButOne) {
  EXPECT_EQ(Weights({1, 2, 3, 4, 5, 6}, 4), Weights({1, 2, 3, 4, 5}, 4));
}

TEST(ComputeWeights, DropsNodesAsFarAsTheLast) {
  EXPECT_THAT(Weights({1, 2, 4, 4, 4}, 4),
              ElementsAre(DoubleNear(0.6, 1e-15), DoubleNear(0.4, 1e-15)));
  EXPECT_THAT(Weights({1, 2, 4.0 - 1e-12, 4, 4}, 4),
              ElementsAre(DoubleNear(0.6, 1e-15), DoubleNear(0.4, 1e-15)));
}

TEST(ComputeWeights, AreEqualWhenAllAreEquallyFar) {
  EXPECT_THAT(Weights({3, 3, 3, 3, 3}, 4), ElementsAre(0.25, 0.25, 0.25, 0.25));
  EXPECT_THAT(Weights({3 - 1e-13, 3, 3, 3, 3}, 4), ElementsAre(0.25, 0.25, 0.25, 0.25));
  EXPECT_THAT(Weights({0, 0, 0}, 2), ElementsAre(0.5, 0.5));
}

TEST(ComputeWeights, OnANodeGiveItTheLargestWeightOnly) {
  // The weights are 1, 0.5, 0.25, 0.25 before the normalisation.
  EXPECT_THAT(Weights({0, 2, 3, 3, 4}, 4), ElementsAre(0.5, 0.25, 0.125, 0.125));
}

TEST(ComputeWeights, PlaceAStepBehindTheLastOfTooFewNodes) {
  EXPECT_THAT(Weights({7}, 4), ElementsAre(1.0));
  EXPECT_THAT(Weights({0}, 4), ElementsAre(1.0));
  // d_max = 2 (1 + 1/2) = 3, so the weights are 2/3 and 1/3.
  EXPECT_THAT(Weights({1, 2}, 4),
              ElementsAre(DoubleNear(2.0 / 3, 1e-15), DoubleNear(1.0 / 3, 1e-15)));
  EXPECT_THAT(Weights({1, 2, kInfinity, kInfinity, kInfinity}, 4),
              ElementsAre(DoubleNear(2.0 / 3, 1e-15), DoubleNear(1.0 / 3, 1e-15)));
  EXPECT_EQ(Weights({1, 1, 1, 1}, 4).size(), 4u);
}

TEST(ComputeWeights, ArePositiveFallAndSumToOne) {
  for (const std::vector<double>& distances :
       std::vector<std::vector<double>>{{0, 0, 0, 0, 0},
                                        {0, 0, 0, 0, 1e-300},
                                        {1e-320, 2e-320, 3e-320, 4e-320, 5e-320},
                                        {1e300, 1e300, 1.5e300, 1.6e300, 1.7e300},
                                        {0, 1, 1, 1, 1},
                                        {0, 0, 1},
                                        {1, 2, 3}}) {
    for (int neighbors = 1; neighbors <= 4; ++neighbors) {
      const std::vector<double> weights = Weights(distances, neighbors);
      ASSERT_GE(weights.size(), 1u);
      double sum = 0.0;
      for (std::size_t i = 0; i < weights.size(); ++i) {
        EXPECT_GT(weights[i], 0.0);
        EXPECT_LE(weights[i], weights[i > 0 ? i - 1 : 0]);
        sum += weights[i];
      }
      EXPECT_NEAR(sum, 1.0, 1e-15);
    }
  }
}

TEST(BindPoints, InSpaceEqualsSortingAllNodes) {
  PointCloud cloud;
  cloud.points = RandomPoints(300, 51);
  const SurfaceTopology topology = BuildTopology(cloud);
  const std::vector<int> node_points = UniformDownsample(cloud.points, 0.6);
  BindingOptions options;
  options.num_threads = 3;
  const Skinning skinning = BindPoints(cloud, topology, node_points, options);
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    std::vector<std::pair<double, int>> all;
    for (std::size_t j = 0; j < node_points.size(); ++j) {
      all.push_back({(cloud.points[p] - cloud.points[node_points[j]]).norm(), j});
    }
    std::sort(all.begin(), all.end());
    ASSERT_EQ(skinning[p].size, 4);
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += 1.0 - all[i].first / all[4].first;
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(skinning[p].nodes[i], all[i].second);
      EXPECT_NEAR(skinning[p].weights[i], (1.0 - all[i].first / all[4].first) / sum, 1e-14);
    }
  }
  options.num_threads = 1;
  ExpectSameToTheBit(BindPoints(cloud, topology, node_points, options), skinning);
}

TEST(BindPoints, SheetsThatTouchNeverShareANode) {
  const PointCloud sheet = MakeGridMesh(21, 21, 0.1);
  const PointCloud mesh = Append(sheet, sheet, {0, 0, 1e-3});
  const SurfaceTopology topology = BuildTopology(mesh);
  const std::vector<int> node_points = UniformDownsampleAlongSurface(topology, 0.4);
  BindingOptions options;
  const Skinning along = BindPoints(mesh, topology, node_points, options);
  options.distance = DistanceRule::kEuclidean;
  const Skinning in_space = BindPoints(mesh, topology, node_points, options);
  int shared_along = 0, shared_in_space = 0;
  for (int p = 0; p < 882; ++p) {
    const auto crosses = [&](const Skinning& skinning, int i) {
      return (node_points[skinning[p].nodes[i]] < 441) != (p < 441);
    };
    for (int i = 0; i < along[p].size; ++i) shared_along += crosses(along, i);
    for (int i = 0; i < in_space[p].size; ++i) shared_in_space += crosses(in_space, i);
  }
  EXPECT_EQ(shared_along, 0);
  EXPECT_GT(shared_in_space, 441);
}

TEST(BindPoints, IslandsWithoutANodeFollowTheNearestInSpace) {
  PointCloud mesh = Append(MakeGridMesh(10, 10), MakeGridMesh(2, 2, 0.1), {9.5, 9.5, 0});
  mesh.points.emplace_back(-1, -1, 0);
  const Skinning skinning =
      BindPoints(mesh, BuildTopology(mesh), {0, 9, 90, 99, 44}, BindingOptions());
  EXPECT_EQ(skinning[100].nodes[0], 3);
  EXPECT_EQ(skinning[104].nodes[0], 0);
}

TEST(BindPoints, AnUnweldedMeshIsBoundAsTheWeldedOne) {
  PointCloud mesh = MakeSphereMesh(3);
  Jitter(0.01, 52, &mesh);
  std::vector<int> source;
  const PointCloud soup = Unweld(mesh, &source);
  const SurfaceTopology topology = BuildTopology(mesh), soup_topology = BuildTopology(soup);
  const std::vector<int> nodes = UniformDownsampleAlongSurface(topology, 0.4);
  const std::vector<int> soup_nodes = UniformDownsampleAlongSurface(soup_topology, 0.4);
  ASSERT_EQ(nodes.size(), soup_nodes.size());
  for (std::size_t j = 0; j < nodes.size(); ++j) EXPECT_EQ(source[soup_nodes[j]], nodes[j]);
  const Skinning welded = BindPoints(mesh, topology, nodes, BindingOptions());
  const Skinning unwelded = BindPoints(soup, soup_topology, soup_nodes, BindingOptions());
  for (std::size_t p = 0; p < soup.size(); ++p) {
    ASSERT_EQ(unwelded[p].size, welded[source[p]].size);
    for (int i = 0; i < unwelded[p].size; ++i) {
      EXPECT_EQ(unwelded[p].nodes[i], welded[source[p]].nodes[i]);
      EXPECT_EQ(unwelded[p].weights[i], welded[source[p]].weights[i]);
    }
  }
}

TEST(BindCloudToGraph, BindsTheSourceItselfToTheBit) {
  PointCloud mesh = MakeSphereMesh(3);
  Jitter(0.01, 53, &mesh);
  mesh = Append(mesh, MakeGridMesh(2, 2, 0.1), {3, 0, 0});
  mesh.points.emplace_back(2, 2, 2);
  std::vector<int> source;
  PointCloud bare = mesh;
  bare.triangles.clear();
  for (const PointCloud& cloud : {mesh, Unweld(mesh, &source), bare}) {
    const SurfaceTopology topology = BuildTopology(cloud);
    for (const DistanceRule distance : {DistanceRule::kSurface, DistanceRule::kEuclidean}) {
      const std::vector<int> nodes = topology.HasSurface()
                                         ? UniformDownsampleAlongSurface(topology, 0.4, 5)
                                         : UniformDownsample(cloud.points, 0.4);
      BindingOptions options;
      options.distance = distance;
      const auto skinning = BindCloudToGraph(cloud, GraphOn(cloud, nodes), options);
      ASSERT_TRUE(skinning.ok());
      ExpectSameToTheBit(*skinning, BindPoints(cloud, topology, nodes, options));
    }
  }
}

TEST(BindCloudToGraph, BindsAFinerCloudMuchAsTheSource) {
  const PointCloud coarse = MakeSphereMesh(3);
  const PointCloud fine = MakeSphereMesh(4);
  const std::vector<int> nodes = UniformDownsampleAlongSurface(BuildTopology(coarse), 0.5);
  const DeformationGraph graph = GraphOn(coarse, nodes);
  const auto skinning = BindCloudToGraph(fine, graph, BindingOptions());
  ASSERT_TRUE(skinning.ok());
  for (std::size_t p = 0; p < fine.size(); ++p) {
    double nearest = kInfinity;
    for (const Eigen::Vector3d& g : graph.positions()) {
      nearest = std::min(nearest, (g - fine.points[p]).norm());
    }
    // Paths along edges are up to 5 % and arcs up to 2 % longer than chords.
    const Eigen::Vector3d& first = graph.position((*skinning)[p].nodes[0]);
    EXPECT_LE((first - fine.points[p]).norm(), 1.08 * nearest);
  }
}

TEST(BindCloudToGraph, BindsAPatchToTheNodesAroundIt) {
  // The patch is nearer to nodes 1 and 2 than to 0; no node is one of its points.
  DeformationGraph graph;
  for (const double x : {0.0, 10.0, 11.0}) graph.AddNode({x, 0, 0});
  const PointCloud patch = Append(PointCloud(), MakeGridMesh(3, 3, 0.1), {9.8, 1, 0});
  BindingOptions options;
  options.neighbors = 2;
  const auto skinning = BindCloudToGraph(patch, graph, options);
  ASSERT_TRUE(skinning.ok());
  for (std::size_t p = 0; p < patch.size(); ++p) {
    ASSERT_EQ((*skinning)[p].size, 2);
    EXPECT_EQ((*skinning)[p].nodes[0], 1);
    EXPECT_EQ((*skinning)[p].nodes[1], 2);
  }
}

TEST(BindCloudToGraph, RefusesAGraphWithoutNodesAndBadOptions) {
  const auto empty = BindCloudToGraph(MakeGridMesh(2, 2), DeformationGraph(), BindingOptions());
  EXPECT_THAT(empty.status().message(), HasSubstr("without nodes"));
  DeformationGraph graph;
  graph.AddNode({0, 0, 0});
  BindingOptions options;
  options.neighbors = 9;
  const auto bad = BindCloudToGraph(MakeGridMesh(2, 2), graph, options);
  EXPECT_THAT(bad.status().message(),
              HasSubstr("neighbors is 9, expected a whole number from 1 to 8"));
}

}  // namespace
}  // namespace ceres_ed
