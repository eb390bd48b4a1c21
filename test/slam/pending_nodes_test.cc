#include "ceres_ed/slam/levels/pending_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Returns the chain 0 - 1 - 2 - 3 - 4 with edges in both directions.
DeformationGraph Chain() {
  DeformationGraph graph;
  for (int j = 0; j < 5; ++j) graph.AddNode({1.0 * j, 0.0, 0.0});
  for (int j = 0; j < 4; ++j) {
    graph.AddEdge({j, j + 1, 1.0});
    graph.AddEdge({j + 1, j, 1.0});
  }
  return graph;
}

LevelWindow Window(const std::vector<int>& variable) {
  LevelWindow window;
  window.nodes = variable;
  window.num_variable = static_cast<int>(variable.size());
  return window;
}

TEST(PendingNodes, AddUpSmallChangesUntilTheyCount) {
  PendingNodes pending(0.1);
  pending.Raise(3, 0.06);
  EXPECT_THAT(pending.Unsettled(), IsEmpty());
  pending.Raise(3, 0.06);
  EXPECT_THAT(pending.Unsettled(), ElementsAre(3));
  EXPECT_NEAR(pending.change(3), 0.12, 1e-15);
  EXPECT_EQ(pending.change(1000), 0.0);
}

TEST(PendingNodes, UnsettleTheNeighboursOfWhatMoved) {
  const DeformationGraph graph = Chain();
  PendingNodes pending(0.1);
  pending.NoteSolve(Window({1, 2}), graph, {0.3, 0.05}, /*one_step=*/false);
  // Node 3 has moved by less than the tolerance beside node 2; the solved nodes are settled.
  EXPECT_THAT(pending.Unsettled(), ElementsAre(0));
  EXPECT_EQ(pending.change(0), 0.3);
  EXPECT_EQ(pending.change(1), 0.0);
  EXPECT_EQ(pending.change(3), 0.05);
  pending.NoteSolve(Window({2}), graph, {0.06}, /*one_step=*/false);
  EXPECT_THAT(pending.Unsettled(), ElementsAre(0, 3));
}

TEST(PendingNodes, KeepWhatOneStepLeaves) {
  PendingNodes pending(0.1);
  pending.NoteSolve(Window({2, 3}), Chain(), {0.5, 0.2}, /*one_step=*/true);
  EXPECT_EQ(pending.change(2), 0.25);
  EXPECT_NEAR(pending.change(3), 0.04, 1e-15);
  EXPECT_THAT(pending.Unsettled(), ElementsAre(1, 2, 4));
  pending.NoteSolve(Window({1, 2, 3, 4}), Chain(), {0.0, 0.0, 0.0, 0.0}, /*one_step=*/true);
  EXPECT_THAT(pending.Unsettled(), IsEmpty());
}

}  // namespace
}  // namespace ceres_ed
