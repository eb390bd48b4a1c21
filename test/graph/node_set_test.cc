#include "ceres_ed/graph/node_set.h"

#include <ceres_ed/graph/node_neighborhood.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;

TEST(NodeSet, HoldsEachNodeOnce) {
  NodeSet nodes;
  EXPECT_FALSE(nodes.Has(5));
  EXPECT_TRUE(nodes.Add(5));
  EXPECT_TRUE(nodes.Add(2));
  EXPECT_FALSE(nodes.Add(5));
  EXPECT_THAT(nodes.nodes(), ElementsAre(5, 2));
  nodes.Sort();
  EXPECT_THAT(nodes.nodes(), ElementsAre(2, 5));
  EXPECT_TRUE(nodes.Has(2));
  EXPECT_FALSE(nodes.Has(3));
  EXPECT_FALSE(nodes.Has(1000));
}

TEST(NodeSet, IsEmptyAfterClear) {
  NodeSet nodes;
  nodes.Add(3);
  nodes.Clear();
  EXPECT_TRUE(nodes.empty());
  EXPECT_FALSE(nodes.Has(3));
  EXPECT_TRUE(nodes.Add(3));
  EXPECT_EQ(nodes.size(), 1);
}

// Returns the graph 0 - 1 - 2 - 3 - 4 - 5.
DeformationGraph Chain() {
  DeformationGraph graph;
  for (int j = 0; j < 6; ++j) graph.AddNode({1.0 * j, 0.0, 0.0});
  for (int j = 0; j < 5; ++j) graph.AddEdge({j, j + 1, 1.0});
  return graph;
}

TEST(AddRings, AddsRingByRing) {
  NodeSet nodes;
  nodes.Add(1);
  AddRings(
      Chain(), 2, [](int) { return true; }, &nodes);
  EXPECT_THAT(nodes.nodes(), ElementsAre(1, 0, 2, 3));
}

TEST(AddRings, PassesNoNodeThatIsRefused) {
  NodeSet nodes;
  nodes.Add(1);
  AddRings(
      Chain(), 4, [](int node) { return node != 3; }, &nodes);
  EXPECT_THAT(nodes.nodes(), ElementsAre(1, 0, 2));
}

}  // namespace
}  // namespace ceres_ed
