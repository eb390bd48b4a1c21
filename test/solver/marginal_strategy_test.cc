#include "ceres_ed/solver/decoupling/decoupled_solver.h"

#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <ceres/autodiff_cost_function.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

constexpr LinearSolver kLinearSolvers[] = {LinearSolver::kCeres, LinearSolver::kBlock};

// The first `observed` + 1 of eight columns of three nodes are PR.
TestProblemOptions Seen(int observed, bool has_camera = false) {
  TestProblemOptions options;
  options.columns = 8;
  options.observed_columns = observed;
  options.points_per_cell = 4;
  options.has_camera = has_camera;
  options.target_deviation = 0.1;
  return options;
}

StrategyOptions Marginal(int rings, LinearSolver linear_solver = LinearSolver::kBlock) {
  StrategyOptions options;
  options.mode = SolveMode::kMarginal;
  options.rings = rings;
  options.linear_solver = linear_solver;
  return options;
}

SolverOptions Converging() {
  SolverOptions options;
  options.max_iterations = 200;
  options.function_tolerance = 1e-15;
  options.gradient_tolerance = 1e-13;
  options.parameter_tolerance = 1e-14;
  return options;
}

double Difference(const DeformationState& a, const DeformationState& b) {
  const std::vector<double> one = AllParameters(a);
  const std::vector<double> other = AllParameters(b);
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    largest = std::max(largest, std::abs(one[i] - other[i]));
  }
  return largest;
}

TEST(MarginalStrategy, OneUndampedStepIsTheGaussNewtonStepOfBatch) {
  SolverOptions one_step;
  one_step.max_iterations = 1;
  one_step.initial_trust_region_radius = 1e16;
  for (const bool has_camera : {false, true}) {
    StripBuilder strip(Seen(2, has_camera));
    if (has_camera) strip.Add("pose_prior", 0.1);
    const DeformationState start = RandomState(strip.problem, 0.05, 3);
    for (const LinearSolver linear_solver : kLinearSolvers) {
      StrategyOptions batch;
      batch.linear_solver = linear_solver;
      DeformationState expected = start;
      const double energy =
          MakeStrategy(batch)->Solve(strip.builder, one_step, &expected).final_energy;
      ASSERT_GT(Difference(expected, start), 0.01);
      for (const int rings : {0, 1, 2}) {
        DeformationState found = start;
        const SolveSummary summary =
            DecoupledSolver(Marginal(rings, linear_solver)).Solve(strip.builder, one_step, &found);
        EXPECT_EQ(summary.TotalIterations(), 2);
        EXPECT_NEAR(summary.final_energy, energy, 1e-9 * energy);
        EXPECT_LT(Difference(found, expected), 1e-9 * Difference(expected, start))
            << rings << " rings" << (has_camera ? ", camera" : "");
      }
    }
  }
}

TEST(MarginalStrategy, ReachesTheMinimumOfBatch) {
  for (const bool has_camera : {false, true}) {
    for (const LossType loss : {LossType::kSquared, LossType::kHuber}) {
      StripBuilder strip(Seen(2, has_camera), "point_to_plane");
      strip.builder.SetLoss(strip.data, {loss, 0.05});
      strip.Add("node_prior", 0.01);
      if (has_camera) strip.Add("pose_prior", 0.1);
      DeformationState batch(24);
      const double energy =
          MakeStrategy({})->Solve(strip.builder, Converging(), &batch).final_energy;
      for (const LinearSolver linear_solver : kLinearSolvers) {
        DeformationState found(24);
        const SolveSummary summary =
            DecoupledSolver(Marginal(1, linear_solver)).Solve(strip.builder, Converging(), &found);
        EXPECT_EQ(summary.status, SolveStatus::kConverged);
        EXPECT_NEAR(summary.final_energy, energy, 1e-9 * energy);
        EXPECT_LT(Difference(found, batch), 1e-5);
      }
    }
  }
}

// New correspondences do not change the elimination, and the minimum is still correct.
TEST(MarginalStrategy, KeepsTheEliminationWhileHiddenNodesStayNearIt) {
  StripBuilder strip(Seen(3));
  DeformationState state(24);
  DecoupledSolver strategy(Marginal(0));
  strategy.Solve(strip.builder, Converging(), &state);
  const int eliminations = strategy.marginalization().num_eliminations();
  EXPECT_GE(eliminations, 1);
  for (int frame = 0; frame < 3; ++frame) {
    for (Correspondence& c : strip.problem.correspondences) c.target.z() += 1e-4;
    strip.builder.CollectResiduals(
        strip.data, **strip.registry.Create("point_to_point", {}), strip.problem.Context());
    const SolveSummary summary = strategy.Solve(strip.builder, Converging(), &state);
    EXPECT_EQ(strategy.marginalization().num_eliminations(), eliminations);
    DeformationState expected = state;
    const double energy =
        MakeStrategy({})->Solve(strip.builder, Converging(), &expected).final_energy;
    EXPECT_NEAR(summary.final_energy, energy, 1e-9 * energy);
    EXPECT_LT(Difference(state, expected), 1e-5);
  }
  // Other weights give another Lambda.
  strip.builder.SetWeight(strip.rotation, 5.0);
  strategy.Solve(strip.builder, Converging(), &state);
  EXPECT_GT(strategy.marginalization().num_eliminations(), eliminations);
}

// One object solves while nodes come into view and leave it, weights change and the graph grows.
TEST(MarginalStrategy, ForgetsNothingAndKeepsNothingStale) {
  DecoupledSolver reused(Marginal(0));
  for (const int observed : {2, 4, 3, 7, 2}) {
    TestProblemOptions options = Seen(observed);
    if (observed == 4) options.columns = 9;
    StripBuilder strip(options);
    if (observed == 3) strip.builder.SetWeight(strip.rotation, 4.0);
    const int num_nodes = strip.problem.graph.num_nodes();
    DeformationState with_reused(num_nodes);
    DeformationState with_batch(num_nodes);
    const double energy = reused.Solve(strip.builder, Converging(), &with_reused).final_energy;
    const double expected =
        MakeStrategy({})->Solve(strip.builder, Converging(), &with_batch).final_energy;
    EXPECT_NEAR(energy, expected, 1e-9 * expected) << observed;
    EXPECT_LT(Difference(with_reused, with_batch), 1e-5) << observed;
  }
}

// Without E_rot, one direction is free at every node, so that Lambda_ff is singular.
TEST(MarginalStrategy, HoldsByDampingWhatNothingElseHolds) {
  StripBuilder strip(Seen(2));
  strip.builder.SetWeight(strip.rotation, 0.0);
  DeformationState batch = RandomState(strip.problem, 0.1, 5);
  DeformationState found = batch;
  const double energy = MakeStrategy({})->Solve(strip.builder, Converging(), &batch).final_energy;
  const SolveSummary summary =
      DecoupledSolver(Marginal(0)).Solve(strip.builder, Converging(), &found);
  EXPECT_EQ(summary.status, SolveStatus::kConverged) << summary.message;
  EXPECT_NEAR(summary.final_energy, energy, 1e-9 * summary.initial_energy);
}

TEST(MarginalStrategy, MovesHiddenNodesToTheirBestWhereNothingIsSeen) {
  for (const LinearSolver linear_solver : kLinearSolvers) {
    StripBuilder strip(Seen(0));
    DeformationState state = RandomState(strip.problem, 0.1, 5);
    const SolveSummary summary =
        DecoupledSolver(Marginal(2, linear_solver)).Solve(strip.builder, Converging(), &state);
    EXPECT_EQ(summary.status, SolveStatus::kConverged) << summary.message;
    EXPECT_EQ(summary.levels[0].num_variable_nodes, 0);
    EXPECT_EQ(summary.levels[1].num_variable_nodes, 24);
    EXPECT_GT(summary.initial_energy, 1.0);
    EXPECT_LT(summary.final_energy, 1e-12);
    EXPECT_EQ(summary.final_energy, strip.builder.Evaluate(state).Total());
  }
}

// Far from the minimum the linearised energy predicts too much, so steps are damped until they
// decrease the energy.
TEST(MarginalStrategy, NeverRaisesTheEnergyFromFarAway) {
  StripBuilder strip(Seen(2));
  for (int seed = 1; seed <= 10; ++seed) {
    const DeformationState start = RandomState(strip.problem, 1.5, seed);
    for (const int iterations : {1, 2, 3, 50}) {
      SolverOptions options;
      options.max_iterations = iterations;
      DeformationState state = start;
      const SolveSummary summary =
          DecoupledSolver(Marginal(0)).Solve(strip.builder, options, &state);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      const double energy = strip.builder.Evaluate(state).Total();
      EXPECT_NEAR(summary.final_energy, energy, 1e-11 * summary.initial_energy);
      const double expected = iterations == 50 ? 0.1 : 1.0;
      EXPECT_LE(summary.final_energy, expected * summary.initial_energy) << seed;
    }
  }
}

// A prior that couples the last node to the camera.
struct CameraTie {
  template <typename T>
  bool operator()(const T* node, const T* translation, T* residual) const {
    residual[0] = node[kNodeTranslationOffset] - translation[0];
    return true;
  }
};

class CameraTieEnergy final : public EnergyTerm {
 public:
  EnergyKind kind() const override { return EnergyKind::kPrior; }
  void AddResiduals(const EnergyContext& context, ResidualSink* sink) const override {
    const BlockRef blocks[] = {BlockRef::Node(context.graph->num_nodes() - 1),
                               BlockRef::CameraTranslation()};
    sink->Add(
        std::make_unique<ceres::AutoDiffCostFunction<CameraTie, 1, kNodeSize, 3>>(new CameraTie),
        blocks,
        2);
  }
};

// The node is kept with the camera, and the minimum is still that of the batch solve.
TEST(MarginalStrategy, ReachesTheMinimumOfBatchWhereAPriorJoinsAHiddenNodeToTheCamera) {
  StripBuilder strip(Seen(2, true), "point_to_plane");
  strip.Add("node_prior", 0.01);
  strip.Add("pose_prior", 0.1);
  const int tie = strip.builder.AddTerm("camera_tie", EnergyKind::kPrior);
  strip.builder.CollectResiduals(tie, CameraTieEnergy(), strip.problem.Context());
  DeformationState batch(24);
  const double energy = MakeStrategy({})->Solve(strip.builder, Converging(), &batch).final_energy;
  DeformationState found(24);
  const SolveSummary summary =
      DecoupledSolver(Marginal(0)).Solve(strip.builder, Converging(), &found);
  EXPECT_EQ(summary.status, SolveStatus::kConverged);
  EXPECT_NEAR(summary.final_energy, energy, 1e-9 * energy);
  EXPECT_LT(Difference(found, batch), 1e-5);
}

}  // namespace
}  // namespace ceres_ed
