#include "ceres_ed/problem/problem_config.h"

#include <ceres_ed/testing/test_problem.h>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// A strip of 6 columns with 3 nodes each. The first column is PR.
TestProblem Strip() { return MakeTestProblem({}); }
std::vector<char> FirstColumns(int columns) {
  std::vector<char> mask(18, 0);
  for (int j = 0; j < 3 * columns; ++j) mask[j] = 1;
  return mask;
}

TEST(FullConfig, HasEveryNodeAndTheCameraWhereThereIsOne) {
  const ProblemConfig without = FullConfig(4, false);
  EXPECT_EQ(without.variable_nodes, std::vector<char>(4, 1));
  EXPECT_FALSE(without.camera_variable);
  EXPECT_EQ(without.NumVariableNodes(), 4);
  EXPECT_TRUE(FullConfig(4, true).camera_variable);
}

TEST(LevelOneConfig, HasThePointRelevantNodesAndTheirRings) {
  const TestProblem strip = Strip();
  for (int rings = 0; rings <= 7; ++rings) {
    const ProblemConfig config =
        LevelOneConfig(strip.graph, FirstColumns(1), true, BoundaryEdges::kCut, rings);
    EXPECT_EQ(config.variable_nodes, FirstColumns(std::min(6, 1 + rings))) << rings;
    EXPECT_EQ(config.NumVariableNodes(), 3 * std::min(6, 1 + rings));
    EXPECT_TRUE(config.camera_variable);
    EXPECT_EQ(config.boundary_edges, BoundaryEdges::kCut);
  }
}

TEST(LevelOneConfig, HoldsEveryNodeWhereNothingIsSeen) {
  const TestProblem strip = Strip();
  const ProblemConfig config =
      LevelOneConfig(strip.graph, std::vector<char>(18, 0), false, BoundaryEdges::kKeep, 3);
  EXPECT_EQ(config.NumVariableNodes(), 0);
  EXPECT_FALSE(config.camera_variable);
}

TEST(LevelTwoConfig, HasTheRestAndNoCamera) {
  const ProblemConfig config = LevelTwoConfig(FirstColumns(2));
  EXPECT_EQ(config.NumVariableNodes(), 12);
  for (int j = 0; j < 18; ++j) EXPECT_EQ(config.variable_nodes[j] != 0, j >= 6);
  EXPECT_FALSE(config.camera_variable);
  EXPECT_EQ(config.boundary_edges, BoundaryEdges::kKeep);
}

}  // namespace
}  // namespace ceres_ed
