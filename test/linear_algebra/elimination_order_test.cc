#include "ceres_ed/linear_algebra/elimination_order.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

RowGraph GraphOf(int num_vertices, const std::vector<std::pair<int, int>>& edges) {
  std::vector<std::vector<int>> neighbors(num_vertices);
  for (const auto& [a, b] : edges) {
    neighbors[a].push_back(b);
    neighbors[b].push_back(a);
  }
  RowGraph graph;
  graph.sizes.assign(num_vertices, 3);
  graph.is_dual.assign(num_vertices, 0);
  graph.begins = {0};
  for (const std::vector<int>& list : neighbors) {
    graph.neighbors.insert(graph.neighbors.end(), list.begin(), list.end());
    graph.begins.push_back(static_cast<int>(graph.neighbors.size()));
  }
  return graph;
}

std::vector<std::pair<int, int>> ChainEdges(int first, int length) {
  std::vector<std::pair<int, int>> edges;
  for (int i = first + 1; i < first + length; ++i) edges.emplace_back(i - 1, i);
  return edges;
}

bool IsPermutation(std::vector<int> order) {
  std::vector<int> all(order.size());
  std::iota(all.begin(), all.end(), 0);
  std::sort(order.begin(), order.end());
  return order == all;
}

constexpr OrderingMethod kMethods[] = {OrderingMethod::kMinimumDegree,
                                       OrderingMethod::kNestedDissection};

TEST(EliminationOrder, KeepsBothEndsToThemselves) {
  const RowGraph graph = GraphOf(30, ChainEdges(0, 30));
  std::vector<char> first(30, 0);
  for (int v = 0; v < 24; v += 3) first[v] = 1;
  for (const OrderingMethod method : kMethods) {
    const std::vector<int> order = FillReducingOrder(graph, first, 5, method);
    ASSERT_EQ(order.size(), 30u);
    EXPECT_TRUE(IsPermutation(order));
    for (int k = 0; k < 8; ++k) EXPECT_EQ(first[order[k]], 1) << k;
    for (int k = 25; k < 30; ++k) EXPECT_EQ(order[k], k);
  }
}

// Two chains, each with a dual vertex that is joined to all of it; by degree these dual vertices
// would come last.
TEST(EliminationOrder, HasSomeVerticesOfEachPartBehindItsDuals) {
  std::vector<std::pair<int, int>> edges = ChainEdges(0, 20);
  for (const auto& edge : ChainEdges(20, 20)) edges.push_back(edge);
  for (int v = 0; v < 40; ++v) edges.emplace_back(v, 40 + v / 20);
  RowGraph graph = GraphOf(42, edges);
  graph.is_dual[40] = graph.is_dual[41] = 1;
  for (const OrderingMethod method : kMethods) {
    const std::vector<int> order = FillReducingOrder(graph, std::vector<char>(42, 0), 0, method);
    EXPECT_TRUE(IsPermutation(order));
    std::vector<int> behind(2, 0);
    for (auto v = order.rbegin(); v != order.rend() && *v < 40; ++v) ++behind[*v / 20];
    EXPECT_EQ(behind, (std::vector<int>{4, 4}));
  }
}

}  // namespace
}  // namespace ceres_ed
