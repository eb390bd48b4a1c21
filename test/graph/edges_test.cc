#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/graph/edges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

template <typename Edges>
std::set<std::pair<int, int>> Pairs(const Edges& edges) {
  std::set<std::pair<int, int>> pairs;
  for (const GraphEdge& edge : edges) pairs.insert({edge.from, edge.to});
  return pairs;
}

TEST(SharedInfluenceEdges, WeighByTheProductsOfTheWeights) {
  Skinning skinning(3);
  const int first[] = {0, 1, 2};
  const double first_weights[] = {0.5, 0.3, 0.2};
  const int second[] = {1, 2};
  const double second_weights[] = {0.6, 0.4};
  skinning.Add(first, first_weights, 3);
  skinning.Add(second, second_weights, 2);
  // The sums are 0.15 for nodes 0 and 1, 0.10 for 0 and 2, and 0.06 + 0.24 = 0.30 for 1 and 2. The
  // mean is 0.55 / 3.
  const std::vector<GraphEdge> edges = SharedInfluenceEdges(skinning, 4, 8);
  ASSERT_EQ(Pairs(edges),
            (std::set<std::pair<int, int>>{{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}));
  std::map<std::pair<int, int>, double> weights;
  for (const GraphEdge& edge : edges) weights[{edge.from, edge.to}] = edge.weight;
  EXPECT_NEAR((weights[{0, 1}]), 0.45 / 0.55, 1e-14);
  EXPECT_NEAR((weights[{0, 2}]), 0.30 / 0.55, 1e-14);
  EXPECT_NEAR((weights[{1, 2}]), 0.90 / 0.55, 1e-14);
  EXPECT_EQ((weights[{1, 2}]), (weights[{2, 1}]));
}

TEST(SharedInfluenceEdges, StayIfEitherEndKeepsThem) {
  // Node 0 shares 0.25 points with each of 1, 2 and 3, and most with 3.
  Skinning skinning(2);
  for (int other = 1; other <= 3; ++other) {
    const int nodes[] = {0, other};
    const double weights[] = {0.9 - 0.1 * other, 0.1 + 0.1 * other};
    skinning.Add(nodes, weights, 2);
  }
  // Node 0 chooses only 3, but 0 is the strongest partner of 1 and 2.
  EXPECT_EQ(SharedInfluenceEdges(skinning, 4, 1).size(), 6u);
}

TEST(SharedInfluenceEdges, HaveMeanOneAndABoundedRatio) {
  Skinning skinning(2);
  const auto add = [&skinning](int a, int b, double weight) {
    const int nodes[] = {a, b};
    const double weights[] = {1.0 - weight, weight};
    skinning.Add(nodes, weights, 2);
  };
  for (int i = 0; i < 5000; ++i) add(0, 1, 0.5);
  for (int j = 1; j < 20; ++j) add(j, j + 1, 1e-8);
  const std::vector<GraphEdge> edges = SharedInfluenceEdges(skinning, 21, 8);
  double sum = 0.0, low = 1e9, high = 0.0;
  for (const GraphEdge& edge : edges) {
    sum += edge.weight;
    low = std::min(low, edge.weight);
    high = std::max(high, edge.weight);
  }
  EXPECT_NEAR(sum / static_cast<double>(edges.size()), 1.0, 1e-12);
  EXPECT_NEAR(high / low, 100.0, 1e-9);
}

TEST(NearestNodeEdges, JoinNeighborsOfALatticeBothWays) {
  const PointCloud mesh = MakeGridMesh(9, 9);
  std::vector<int> nodes;
  for (int row = 0; row < 9; row += 4) {
    for (int column = 0; column < 9; column += 4) nodes.push_back(row * 9 + column);
  }
  for (const DistanceRule distance : {DistanceRule::kSurface, DistanceRule::kEuclidean}) {
    const auto pairs = Pairs(NearestNodeEdges(mesh, BuildTopology(mesh), nodes, 2, distance));
    // A corner is linked to its two neighbours along the rim.
    EXPECT_TRUE(pairs.count({0, 1}) == 1 && pairs.count({0, 3}) == 1 && pairs.count({0, 4}) == 0);
    for (const auto& [from, to] : pairs) EXPECT_EQ(pairs.count({to, from}), 1u);
  }
}

TEST(NearestNodeEdges, AlongTheSurfaceDoNotJumpBetweenSheets) {
  const PointCloud sheet = MakeGridMesh(9, 9);
  const PointCloud mesh = Append(sheet, sheet, {0, 0, 0.01});
  const std::vector<int> nodes = {0, 8, 40, 72, 80, 81, 89, 121, 153, 161};
  const SurfaceTopology topology = BuildTopology(mesh);
  for (const auto& [from, to] :
       Pairs(NearestNodeEdges(mesh, topology, nodes, 3, DistanceRule::kSurface))) {
    EXPECT_EQ(from < 5, to < 5);
  }
  EXPECT_EQ(
      Pairs(NearestNodeEdges(mesh, topology, nodes, 3, DistanceRule::kEuclidean)).count({0, 5}),
      1u);
}

// Returns three rows of three nodes, `gap` apart. Each row is a chain.
DeformationGraph ThreeRows(double gap) {
  DeformationGraph graph;
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 3; ++i) graph.AddNode({static_cast<double>(i), row * gap, 0.0});
    for (int i = 0; i < 2; ++i) {
      graph.AddEdge({3 * row + i, 3 * row + i + 1, 1.0});
      graph.AddEdge({3 * row + i + 1, 3 * row + i, 1.0});
    }
  }
  return graph;
}

TEST(JoinPieces, MakesOnePieceWithSeveralEdgesAJoint) {
  DeformationGraph graph = ThreeRows(5.0);
  EXPECT_EQ(ConnectedPieces(graph), (std::vector<int>{0, 0, 0, 1, 1, 1, 2, 2, 2}));
  const int num_edges = graph.num_edges();
  EXPECT_EQ(JoinPieces(&graph, 3), 3);
  EXPECT_EQ(ConnectedPieces(graph), std::vector<int>(9, 0));
  const auto pairs = Pairs(graph.edges());
  EXPECT_EQ(graph.num_edges(), num_edges + 12);
  EXPECT_EQ(pairs.size(), static_cast<std::size_t>(graph.num_edges()));
  // Neighbouring rows are joined by edges straight across.
  for (int i = 0; i < 6; ++i) EXPECT_EQ(pairs.count({i, i + 3}), 1u);
}

TEST(JoinPieces, ALoneNodeIsHeldByDifferentNodes) {
  DeformationGraph graph = ThreeRows(1.0);
  graph.AddNode({1, 1, 9});
  EXPECT_EQ(JoinPieces(&graph, 3), 4);
  std::set<int> partners;
  for (const int e : graph.incident_edges(9)) {
    partners.insert(graph.edges()[e].from + graph.edges()[e].to - 9);
  }
  EXPECT_EQ(partners.size(), 3u);
  EXPECT_EQ(partners.count(4), 1u);
}

TEST(JoinPieces, JoinsAsManyAsThereAreAndLeavesOnePieceAlone) {
  DeformationGraph two;
  two.AddNode({0, 0, 0});
  two.AddNode({1, 0, 0});
  EXPECT_EQ(JoinPieces(&two, 3), 2);
  EXPECT_EQ(two.num_edges(), 2);
  EXPECT_EQ(JoinPieces(&two, 3), 1);
  EXPECT_EQ(two.num_edges(), 2);
  DeformationGraph none;
  EXPECT_EQ(JoinPieces(&none, 3), 0);
}

TEST(CarryPieces, LinksCarriedNodesToNearNodesOfOtherPieces) {
  DeformationGraph graph;
  // Three rows of nodes; the one in the middle is carried.
  std::vector<int> piece;
  for (int row = 0; row < 3; ++row) {
    for (int j = 0; j < 5; ++j) {
      graph.AddNode({1.0 * j, 0.1 * row, 0.0});
      piece.push_back(row);
    }
  }
  EXPECT_EQ(CarryPieces(piece, {0, 1, 0}, 2, 0.5, &graph), 10);
  EXPECT_EQ(graph.edges().size(), 20u);
  for (const GraphEdge& edge : graph.edges()) {
    EXPECT_EQ(edge.from % 5, edge.to % 5);
    EXPECT_EQ(std::abs(piece[edge.from] - piece[edge.to]), 1);
  }
  EXPECT_EQ(CarryPieces(piece, {0, 1, 0}, 2, 0.5, &graph), 0) << "they are linked already";
  EXPECT_EQ(CarryPieces(piece, {1, 1, 1}, 2, 0.01, &graph), 0) << "nothing is within reach";
}

}  // namespace
}  // namespace ceres_ed
