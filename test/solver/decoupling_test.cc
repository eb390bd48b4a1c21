#include "ceres_ed/solver/decoupling/decoupling.h"

#include <ceres_ed/solver/decoupling/decoupled_solver.h>
#include <ceres_ed/testing/test_problem.h>

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAreArray;

constexpr int kRows = 4;

// Returns a strip of columns of four nodes; node column * 4 + row.
TestProblem Strip(int columns = 30) {
  TestProblemOptions options;
  options.columns = columns;
  options.rows = kRows;
  return MakeTestProblem(options);
}

NodeSet Columns(int first, int last) {
  NodeSet nodes;
  for (int j = kRows * first; j < kRows * last; ++j) nodes.Add(j);
  return nodes;
}

StrategyOptions Options(SolveMode mode, int rings, int reach = -1) {
  StrategyOptions options;
  options.mode = mode;
  options.rings = rings;
  options.marginal_reach = reach;
  options.boundary_edges = BoundaryEdges::kCut;
  return options;
}

TEST(Decoupler, OfBatchMovesEveryNode) {
  const TestProblem strip = Strip();
  Decoupler decoupler(Options(SolveMode::kBatch, 1));
  const Decoupling& nodes = decoupler.Choose(strip.graph, Columns(3, 5));
  EXPECT_THAT(nodes.moved.nodes(), ElementsAreArray(Columns(0, 30).nodes()));
  EXPECT_TRUE(nodes.eliminated.empty());
  EXPECT_FALSE(nodes.HoldsNodes(120));
}

TEST(Decoupler, OfTwoLevelMovesRingsAndHoldsTheRest) {
  const TestProblem strip = Strip();
  for (int rings = 0; rings <= 3; ++rings) {
    Decoupler decoupler(Options(SolveMode::kTwoLevel, rings));
    const Decoupling& nodes = decoupler.Choose(strip.graph, Columns(10, 12));
    EXPECT_THAT(nodes.moved.nodes(), ElementsAreArray(Columns(10 - rings, 12 + rings).nodes()));
    EXPECT_TRUE(nodes.eliminated.empty());
    EXPECT_EQ(nodes.boundary_edges, BoundaryEdges::kCut);
    EXPECT_TRUE(nodes.HoldsNodes(120));
  }
}

TEST(Decoupler, OfTwoLevelEndsAtTheEdgesOfTheGraph) {
  const TestProblem strip = Strip(/*columns=*/6);
  Decoupler decoupler(Options(SolveMode::kTwoLevel, 9));
  EXPECT_EQ(decoupler.Choose(strip.graph, Columns(0, 1)).moved.size(), 6 * kRows);
  EXPECT_TRUE(decoupler.Choose(strip.graph, NodeSet()).moved.empty());
}

TEST(Decoupler, OfMarginalEliminatesWithinItsReach) {
  const TestProblem strip = Strip();
  Decoupler decoupler(Options(SolveMode::kMarginal, 1, 3));
  const Decoupling& nodes = decoupler.Choose(strip.graph, Columns(0, 2));
  EXPECT_THAT(nodes.moved.nodes(), ElementsAreArray(Columns(0, 3).nodes()));
  EXPECT_THAT(nodes.eliminated.nodes(), ElementsAreArray(Columns(3, 6).nodes()));
  // A prior at the boundary has been eliminated with the nodes behind it, so there is nothing to
  // cut.
  EXPECT_EQ(nodes.boundary_edges, BoundaryEdges::kKeep);
  EXPECT_TRUE(nodes.HoldsNodes(120));
  Decoupler without_bound(Options(SolveMode::kMarginal, 1));
  const Decoupling& all = without_bound.Choose(strip.graph, Columns(0, 2));
  EXPECT_THAT(all.eliminated.nodes(), ElementsAreArray(Columns(3, 30).nodes()));
  EXPECT_FALSE(all.HoldsNodes(120));
}

TEST(Decoupling, BecomesAProblemOverTheGraph) {
  Decoupling nodes;
  nodes.moved.Add(2);
  nodes.boundary_edges = BoundaryEdges::kCut;
  ProblemConfig config = nodes.LevelOne(4, /*camera_variable=*/true);
  EXPECT_EQ(config.variable_nodes, (std::vector<char>{0, 0, 1, 0}));
  EXPECT_TRUE(config.eliminated_nodes.empty());
  EXPECT_TRUE(config.camera_variable);
  EXPECT_EQ(config.boundary_edges, BoundaryEdges::kCut);
  nodes.eliminated.Add(0);
  config = nodes.LevelOne(4, /*camera_variable=*/false);
  EXPECT_EQ(config.eliminated_nodes, (std::vector<char>{1, 0, 0, 0}));
  EXPECT_FALSE(config.camera_variable);
}

TEST(Decoupler, KeepsItsNodesWhileTheyServe) {
  const TestProblem strip = Strip();
  Decoupler decoupler(Options(SolveMode::kMarginal, 1, 4));
  const Decoupling& nodes = decoupler.Update(strip.graph, Columns(10, 15));
  EXPECT_EQ(nodes.moved.size(), 28);
  EXPECT_EQ(nodes.eliminated.size(), 32);
  const std::vector<int> eliminated = nodes.eliminated.nodes();
  // One column further; all of its nodes had been moved before.
  decoupler.Update(strip.graph, Columns(11, 16));
  EXPECT_EQ(decoupler.num_choices(), 1);
  EXPECT_EQ(nodes.eliminated.nodes(), eliminated);
  // The nodes of another column had been eliminated.
  decoupler.Update(strip.graph, Columns(12, 17));
  EXPECT_EQ(decoupler.num_choices(), 2);
  EXPECT_EQ(nodes.moved.size(), 28);
  EXPECT_EQ(nodes.moved.nodes().front(), 44);
  // Many nodes would be moved without need.
  decoupler.Update(strip.graph, Columns(13, 15));
  EXPECT_EQ(decoupler.num_choices(), 3);
}

TEST(Decoupler, MovesPointRelevantNodesThatItHeld) {
  const TestProblem strip = Strip();
  Decoupler decoupler(Options(SolveMode::kMarginal, 0, 1));
  decoupler.Update(strip.graph, Columns(0, 10));
  // The last column is out of reach.
  NodeSet relevant = Columns(0, 10);
  for (int row = 0; row < kRows; ++row) relevant.Add(29 * kRows + row);
  const Decoupling& nodes = decoupler.Update(strip.graph, relevant);
  EXPECT_EQ(decoupler.num_choices(), 1);
  EXPECT_THAT(nodes.moved.nodes(), ElementsAreArray(relevant.nodes()));
}

TEST(Decoupler, ChoosesAnewInEachTwoLevelProblem) {
  const TestProblem strip = Strip();
  Decoupler decoupler(Options(SolveMode::kTwoLevel, 1));
  decoupler.Update(strip.graph, Columns(10, 15));
  const Decoupling& nodes = decoupler.Update(strip.graph, Columns(11, 15));
  EXPECT_THAT(nodes.moved.nodes(), ElementsAreArray(Columns(10, 16).nodes()));
  EXPECT_EQ(decoupler.num_choices(), 2);
}

// Nodes out of the reach of a marginal Level I follow by Level II.
TEST(DecoupledSolver, MovesNodesOutOfReachAfterwards) {
  TestProblemOptions options;
  options.columns = 10;
  options.observed_columns = 2;
  options.points_per_cell = 4;
  options.target_deviation = 0.3;
  const StripBuilder strip(options);
  DeformationState all = RandomState(strip.problem, 0.1, 8);
  DeformationState near = all;
  const DeformationState start = all;
  const SolveSummary whole =
      DecoupledSolver(Options(SolveMode::kMarginal, 0)).Solve(strip.builder, {}, &all);
  const SolveSummary summary =
      DecoupledSolver(Options(SolveMode::kMarginal, 0, 2)).Solve(strip.builder, {}, &near);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  ASSERT_EQ(whole.levels.size(), 2u);
  ASSERT_EQ(summary.levels.size(), 3u);
  EXPECT_EQ(summary.levels[1].num_variable_nodes, 2 * 3);
  EXPECT_EQ(summary.levels[2].num_variable_nodes, 7 * 3);
  EXPECT_NE(AllParameters(near), AllParameters(start));
  EXPECT_GE(summary.final_energy, whole.final_energy * (1.0 - 1e-9));
  EXPECT_LT(summary.final_energy, 1.1 * whole.final_energy);
  EXPECT_DOUBLE_EQ(summary.final_energy, strip.builder.Evaluate(near).Total());
}

}  // namespace
}  // namespace ceres_ed
