// E_rot does not tell a reflection from a rotation; a solve that starts at rest ends with none.
#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/regression/two_level_scenes.h>

namespace ceres_ed {
namespace {

double SmallestDeterminant(const DeformationState& state) {
  double smallest = HUGE_VAL;
  for (int j = 0; j < state.num_nodes(); ++j) {
    smallest = std::min(smallest, NodeAffine(state.node(j)).determinant());
  }
  return smallest;
}

// x -> x mirrored at a plane: every node's A_j has determinant -1.
DeformationState MirroredState(const DeformationGraph& graph) {
  const Eigen::Vector3d n = Eigen::Vector3d(1.0, 2.0, -0.5).normalized();
  const Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity() - 2.0 * n * n.transpose();
  DeformationState state(graph.num_nodes());
  for (int j = 0; j < graph.num_nodes(); ++j) {
    MutableNodeAffine(state.node(j)) = mirror;
    MutableNodeTranslation(state.node(j)) = mirror * graph.position(j) - graph.position(j);
  }
  return state;
}

TEST(Reflection, CostsNothing) {
  const StripBuilder strip({});
  const DeformationState mirrored = MirroredState(strip.problem.graph);
  EXPECT_NEAR(SmallestDeterminant(mirrored), -1.0, 1e-14);
  const EnergySummary summary = strip.builder.Evaluate(mirrored);
  EXPECT_LT(summary.terms[strip.rotation].raw, 1e-28);
  EXPECT_LT(summary.terms[strip.regularization].raw, 1e-28);
}

TEST(Reflection, OfAllTargetsIsAMinimumWithoutEnergy) {
  TestProblemOptions options;
  options.points_per_cell = 4;
  StripBuilder strip(options);
  DeformationState state = MirroredState(strip.problem.graph);
  for (Correspondence& c : strip.problem.correspondences) {
    const Eigen::Vector3d n = Eigen::Vector3d(1.0, 2.0, -0.5).normalized();
    c.target -= 2.0 * n * n.dot(c.target);
  }
  strip.builder.CollectResiduals(
      strip.data, **strip.registry.Create("point_to_point", {}), strip.problem.Context());
  const SolveSummary summary = MakeStrategy({})->Solve(strip.builder, {}, &state);
  EXPECT_LT(summary.final_energy, 1e-20);
  EXPECT_LT(SmallestDeterminant(state), -0.99);
}

TEST(Reflection, DoesNotHappenFromRest) {
  for (const RegressionScene& scene : {MakeStripScene(), MakePlaneScene(), MakeHeartScene()}) {
    const SceneProblem problem(scene);
    for (const StrategyOptions& options : {BatchOptions(),
                                           TwoLevelOptions(BoundaryEdges::kKeep, 0),
                                           TwoLevelOptions(BoundaryEdges::kKeep, 2),
                                           TwoLevelOptions(BoundaryEdges::kCut, 0)}) {
      EXPECT_GT(SmallestDeterminant(problem.Solve(options).state), 0.2) << scene.name;
    }
  }
}

}  // namespace
}  // namespace ceres_ed
