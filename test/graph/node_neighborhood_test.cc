#include <ceres_ed/graph/node_neighborhood.h>

#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Returns the graph 0 -> 1 -> 2 -> 3 -> 4, and node 5 without edges.
DeformationGraph Chain() {
  DeformationGraph graph;
  for (int i = 0; i < 6; ++i) graph.AddNode({static_cast<double>(i), 0, 0});
  for (int i = 0; i < 4; ++i) graph.AddEdge({i, i + 1, 1.0});
  return graph;
}

TEST(RingsAround, NoRingIsTheSeeds) {
  EXPECT_EQ(RingsAround(Chain(), {0, 0, 7, 0, 0, 0}, 0), (std::vector<char>{0, 0, 1, 0, 0, 0}));
}

TEST(RingsAround, GoesOneEdgeARingInBothDirections) {
  EXPECT_EQ(RingsAround(Chain(), {0, 0, 1, 0, 0, 0}, 1), (std::vector<char>{0, 1, 1, 1, 0, 0}));
  EXPECT_EQ(RingsAround(Chain(), {1, 0, 0, 0, 0, 0}, 2), (std::vector<char>{1, 1, 1, 0, 0, 0}));
}

TEST(RingsAround, DoesNotReachOtherPieces) {
  EXPECT_EQ(RingsAround(Chain(), {1, 0, 0, 0, 0, 0}, 99), (std::vector<char>{1, 1, 1, 1, 1, 0}));
  EXPECT_EQ(RingsAround(Chain(), {0, 0, 0, 0, 0, 0}, 99), std::vector<char>(6, 0));
}

}  // namespace
}  // namespace ceres_ed
