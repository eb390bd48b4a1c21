// The solve with PI nodes marginalised against the batch solve, on half-seen surfaces.
#include <ceres_ed/solver/decoupling/decoupled_solver.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <test/regression/two_level_scenes.h>

namespace ceres_ed {
namespace {

StrategyOptions MarginalOptions(int rings, LinearSolver linear_solver = LinearSolver::kBlock) {
  StrategyOptions options;
  options.mode = SolveMode::kMarginal;
  options.rings = rings;
  options.linear_solver = linear_solver;
  return options;
}

double LargestDifference(const DeformationState& a, const DeformationState& b) {
  double largest = 0.0;
  for (int j = 0; j < a.num_nodes(); ++j) {
    for (int i = 0; i < kNodeSize; ++i) {
      largest = std::max(largest, std::abs(a.node(j)[i] - b.node(j)[i]));
    }
  }
  return largest;
}

void ExpectMinimumOfBatch(const RegressionScene& scene, const StrategyOptions& options) {
  const SceneProblem problem(scene);
  const SceneResult batch = problem.Solve(BatchOptions());
  const SceneResult marginal = problem.Solve(options);
  const std::string what = scene.name + ", " + std::to_string(options.rings) + " rings";
  ASSERT_EQ(batch.summary.status, SolveStatus::kConverged) << what;
  EXPECT_EQ(marginal.summary.status, SolveStatus::kConverged) << what;
  EXPECT_NEAR(marginal.energy, batch.energy, 1e-9 * batch.energy) << what;
  EXPECT_LT(LargestDifference(marginal.state, batch.state), 1e-5) << what;
  // Steps of the full problem: what is hidden is hardly damped.
  EXPECT_LE(marginal.summary.levels[1].iterations, batch.summary.TotalIterations()) << what;
}

TEST(Marginal, ReachesTheMinimumOfBatch) {
  for (const RegressionScene& scene :
       {MakeStripScene(), MakeStripScene(0.1), MakePlaneScene(), MakeHeartScene()}) {
    for (const int rings : {0, 2, 4}) ExpectMinimumOfBatch(scene, MarginalOptions(rings));
  }
}

TEST(Marginal, ReachesTheMinimumOfBatchWithCeres) {
  for (const RegressionScene& scene : {MakePlaneScene(), MakeHeartScene()}) {
    ExpectMinimumOfBatch(scene, MarginalOptions(1, LinearSolver::kCeres));
  }
}

}  // namespace
}  // namespace ceres_ed
