#include "ceres_ed/slam/levels/level_window.h"

#include <ceres_ed/testing/test_problem.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAreArray;

using Edge = std::tuple<int, int, double>;

// Returns the graph of the strip with a different weight for each edge.
DeformationGraph WeightedStrip(const TestProblem& problem) {
  DeformationGraph graph;
  for (const Eigen::Vector3d& g : problem.graph.positions()) graph.AddNode(g);
  for (GraphEdge edge : problem.graph.edges()) {
    edge.weight = 0.5 + graph.num_edges();
    graph.AddEdge(edge);
  }
  return graph;
}

// Returns the edges of the window, by the nodes of the map.
std::vector<Edge> EdgesOf(const LevelWindow& window) {
  std::vector<Edge> edges;
  for (const GraphEdge& e : window.graph.edges()) {
    edges.emplace_back(window.nodes[e.from], window.nodes[e.to], e.weight);
  }
  return edges;
}

std::vector<Edge> EdgesThatTouch(const DeformationGraph& graph, const std::vector<int>& nodes) {
  const auto has = [&](int j) { return std::count(nodes.begin(), nodes.end(), j) != 0; };
  std::vector<Edge> edges;
  for (const GraphEdge& e : graph.edges()) {
    if (has(e.from) || has(e.to)) edges.emplace_back(e.from, e.to, e.weight);
  }
  return edges;
}

class LevelWindowTest : public ::testing::Test {
 protected:
  const TestProblem problem_ = MakeTestProblem({});
  const DeformationGraph graph_ = WeightedStrip(problem_);
  const DeformationState state_ = RandomState(problem_, 0.3, 4);
  LevelWindowBuilder builder_;
};

TEST_F(LevelWindowTest, HasEveryEdgeOfItsVariableNodesOnce) {
  for (const std::vector<int>& variable :
       {std::vector<int>{4}, {7, 4, 5}, {0, 1, 2, 3, 8}, {17, 0}}) {
    const LevelWindow window = builder_.Build(graph_, state_, variable, {});
    EXPECT_THAT(EdgesOf(window), UnorderedElementsAreArray(EdgesThatTouch(graph_, variable)));
    EXPECT_EQ(window.num_variable, static_cast<int>(variable.size()));
  }
}

TEST_F(LevelWindowTest, HoldsNeighboursAndWhatIsNamedAndNothingElse) {
  // Node 4 lies in the middle of its neighbours 1, 3, 5 and 7.
  const LevelWindow window = builder_.Build(graph_, state_, {4}, {16, 3});
  ASSERT_EQ(window.nodes.size(), 6u);
  EXPECT_EQ(window.nodes[0], 4);
  EXPECT_THAT(window.nodes, ::testing::UnorderedElementsAre(4, 16, 3, 1, 5, 7));
  for (int i = 0; i < 6; ++i) {
    const int node = window.nodes[i];
    EXPECT_EQ(window.graph.position(i), graph_.position(node));
    EXPECT_TRUE(
        std::equal(window.state.node(i), window.state.node(i) + kNodeSize, state_.node(node)));
    EXPECT_EQ(builder_.Local(node), i);
  }
  EXPECT_EQ(builder_.Local(0), -1);
  EXPECT_EQ(builder_.Local(17), -1);
}

TEST_F(LevelWindowTest, MovesVariableNodesAlone) {
  const LevelWindow window = builder_.Build(graph_, state_, {4, 5}, {});
  const ProblemConfig config = window.Config(/*camera_variable=*/true, BoundaryEdges::kCut);
  EXPECT_EQ(config.NumVariableNodes(), 2);
  EXPECT_EQ(config.variable_nodes.size(), window.nodes.size());
  EXPECT_NE(config.variable_nodes[0], 0);
  EXPECT_NE(config.variable_nodes[1], 0);
  EXPECT_TRUE(config.camera_variable);
  EXPECT_EQ(config.boundary_edges, BoundaryEdges::kCut);
  EXPECT_FALSE(window.Config(false, BoundaryEdges::kKeep).camera_variable);
}

TEST_F(LevelWindowTest, ForgetsTheWindowBeforeAndFollowsAGrowingGraph) {
  builder_.Build(graph_, state_, {4}, {});
  DeformationGraph grown = graph_;
  const int node = grown.AddNode({1.0, 2.0, 3.0});
  grown.AddEdge({node, 17, 1.0});
  DeformationState state = state_;
  state.Resize(grown.num_nodes());
  const LevelWindow window = builder_.Build(grown, state, {node}, {});
  EXPECT_THAT(window.nodes, ElementsAre(node, 17));
  EXPECT_EQ(builder_.Local(4), -1);
  EXPECT_EQ(builder_.Local(node), 0);
  EXPECT_EQ(window.graph.num_edges(), 1);
}

}  // namespace
}  // namespace ceres_ed
