#include "ceres_ed/solver/strategy.h"

#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

constexpr LinearSolver kLinearSolvers[] = {LinearSolver::kCeres, LinearSolver::kBlock};
constexpr SolveMode kModes[] = {SolveMode::kBatch, SolveMode::kTwoLevel, SolveMode::kMarginal};

std::unique_ptr<Strategy> Make(SolveMode mode,
                               LinearSolver linear_solver,
                               int rings = 0,
                               BoundaryEdges boundary_edges = BoundaryEdges::kKeep) {
  StrategyOptions options;
  options.mode = mode;
  options.rings = rings;
  options.boundary_edges = boundary_edges;
  options.linear_solver = linear_solver;
  return MakeStrategy(options);
}

TEST(SolverOptions, AreValidByDefault) {
  std::string error;
  EXPECT_TRUE(SolverOptions().IsValid(&error)) << error;
  EXPECT_TRUE(StrategyOptions().IsValid(&error)) << error;
}

TEST(SolverOptions, NameTheOptionThatIsOutOfRange) {
  const auto error_of = [](auto set) {
    SolverOptions options;
    set(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    return error;
  };
  EXPECT_EQ(error_of([](SolverOptions* o) { o->max_iterations = -1; }),
            "max_iterations is -1, expected a whole number >= 0");
  EXPECT_EQ(error_of([](SolverOptions* o) { o->function_tolerance = -0.5; }),
            "function_tolerance is -0.5, expected a finite number >= 0");
  EXPECT_EQ(error_of([](SolverOptions* o) { o->gradient_tolerance = -0.5; }),
            "gradient_tolerance is -0.5, expected a finite number >= 0");
  EXPECT_EQ(error_of([](SolverOptions* o) { o->parameter_tolerance = -0.5; }),
            "parameter_tolerance is -0.5, expected a finite number >= 0");
  EXPECT_EQ(error_of([](SolverOptions* o) { o->initial_trust_region_radius = 0.0; }),
            "initial_trust_region_radius is 0, expected a finite number > 0");
  EXPECT_EQ(error_of([](SolverOptions* o) { o->num_threads = 0; }),
            "num_threads is 0, expected a whole number >= 1");
  EXPECT_EQ(error_of([](SolverOptions* o) { o->time_limit_s = 0.0; }),
            "time_limit_s is 0, expected a number > 0");
  StrategyOptions strategy;
  strategy.rings = -2;
  std::string error;
  EXPECT_FALSE(strategy.IsValid(&error));
  EXPECT_EQ(error, "rings is -2, expected a whole number >= 0");
  strategy.rings = 0;
  strategy.relinearize_above = -0.5;
  EXPECT_FALSE(strategy.IsValid(&error));
  EXPECT_EQ(error, "relinearize_above is -0.5, expected a finite number >= 0");
}

TEST(SolveStatusName, IsThatOfTheReport) {
  EXPECT_EQ(NameOf(SolveStatus::kConverged), "converged");
  EXPECT_EQ(NameOf(SolveStatus::kMaxIterations), "max_iterations");
  EXPECT_EQ(NameOf(SolveStatus::kTimeLimit), "time_limit");
  EXPECT_EQ(NameOf(SolveStatus::kInterrupted), "interrupted");
  EXPECT_EQ(NameOf(SolveStatus::kFailed), "failed");
}

TEST(SolveSummary, StartsOutFailed) {
  EXPECT_FALSE(SolveSummary().IsUsable());
  EXPECT_EQ(SolveSummary().TotalIterations(), 0);
}

// E_rot, E_reg and E_data are all zero at A_j = R, t_j = R g_j + T - g_j, and nowhere else near
// rest.
TEST(Strategy, FindsARigidMotionOfAllPoints) {
  TestProblemOptions options;
  options.points_per_cell = 4;
  StripBuilder strip(options);
  CameraPose motion;
  motion.rotation = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1.0, 2.0, -1.0).normalized());
  motion.translation = {0.5, -0.3, 1.0};
  strip.problem.MoveTargets(motion);
  strip.builder.CollectResiduals(
      strip.data, **strip.registry.Create("point_to_point", {}), strip.problem.Context());
  SolverOptions solver;
  solver.max_iterations = 200;
  solver.function_tolerance = 1e-16;
  solver.parameter_tolerance = 1e-14;
  const std::vector<double> expected = AllParameters(RigidState(strip.problem.graph, motion));
  for (const LinearSolver linear_solver : kLinearSolvers) {
    for (const SolveMode mode : kModes) {
      DeformationState state(18);
      const SolveSummary summary = Make(mode, linear_solver)->Solve(strip.builder, solver, &state);
      ASSERT_TRUE(summary.IsUsable());
      EXPECT_LT(summary.final_energy, 1e-20);
      const std::vector<double> found = AllParameters(state);
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9);
    }
  }
}

TEST(Strategy, CountsWhatEachLevelDid) {
  for (const LinearSolver linear_solver : kLinearSolvers) {
    const StripBuilder strip(HalfSeen(true, 4));
    DeformationState state(18);
    const SolveSummary batch =
        Make(SolveMode::kBatch, linear_solver)->Solve(strip.builder, {}, &state);
    ASSERT_EQ(batch.levels.size(), 1u);
    EXPECT_EQ(batch.levels[0].num_variable_nodes, 18);
    EXPECT_DOUBLE_EQ(batch.levels[0].initial_cost, batch.initial_energy);
    EXPECT_NEAR(batch.levels[0].final_cost, batch.final_energy, 1e-12);
    for (int rings = 0; rings <= 3; ++rings) {
      state = DeformationState(18);
      const SolveSummary summary =
          Make(SolveMode::kTwoLevel, linear_solver, rings)->Solve(strip.builder, {}, &state);
      ASSERT_EQ(summary.levels.size(), 2u);
      EXPECT_EQ(summary.levels[0].num_variable_nodes, 9 + 3 * rings);
      EXPECT_EQ(summary.levels[1].num_variable_nodes, 9);
      EXPECT_EQ(summary.TotalIterations(),
                summary.levels[0].iterations + summary.levels[1].iterations);
      for (const LevelSummary& level : summary.levels) {
        EXPECT_GT(level.iterations, 0);
        EXPECT_LT(level.final_cost, level.initial_cost);
        EXPECT_GE(level.build_time_s, 0.0);
        EXPECT_GT(level.solve_time_s, 0.0);
      }
    }
  }
}

TEST(Strategy, SummaryHasTheFullEnergyBeforeAndAfter) {
  for (const LinearSolver linear_solver : kLinearSolvers) {
    for (const SolveMode mode : kModes) {
      const StripBuilder strip(HalfSeen(true, 4));
      DeformationState state = RandomState(strip.problem, 0.1, 8);
      const double before = strip.builder.Evaluate(state).Total();
      const SolveSummary summary = Make(mode, linear_solver)->Solve(strip.builder, {}, &state);
      // The sum has another order.
      EXPECT_NEAR(summary.initial_energy, before, 1e-13 * before);
      EXPECT_NEAR(summary.final_energy, strip.builder.Evaluate(state).Total(), 1e-13 * before);
      EXPECT_LT(summary.final_energy, before);
    }
  }
}

TEST(Strategy, LinearSolversFindTheSameMinimum) {
  const StripBuilder strip(HalfSeen(false, 4));
  SolverOptions solver;
  solver.max_iterations = 200;
  solver.function_tolerance = 1e-15;
  solver.parameter_tolerance = 1e-13;
  for (const SolveMode mode : kModes) {
    DeformationState reference(18);
    DeformationState state(18);
    const double energy =
        Make(mode, LinearSolver::kCeres)->Solve(strip.builder, solver, &reference).final_energy;
    EXPECT_NEAR(Make(mode, LinearSolver::kBlock)->Solve(strip.builder, solver, &state).final_energy,
                energy,
                1e-10 * energy);
    const std::vector<double> expected = AllParameters(reference);
    const std::vector<double> found = AllParameters(state);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6);
  }
}

// Level II on its own: every PI node is at its optimum while the PR nodes are held.
TEST(TwoLevelStrategy, LeavesTheSeenPartAsLevelOneHadIt) {
  for (const BoundaryEdges boundary_edges : {BoundaryEdges::kKeep, BoundaryEdges::kCut}) {
    const StripBuilder strip(HalfSeen(true, 4));
    SolverOptions solver;
    solver.max_iterations = 200;
    solver.function_tolerance = 1e-15;
    DeformationState state(18);
    Make(SolveMode::kTwoLevel, LinearSolver::kCeres, 0, boundary_edges)
        ->Solve(strip.builder, solver, &state);
    const BuiltProblem built = strip.builder.Build(
        LevelOneConfig(
            strip.problem.graph, strip.builder.PointRelevantNodes(), true, boundary_edges, 0),
        &state);
    std::vector<double> gradient;
    built.problem->Evaluate({}, nullptr, nullptr, &gradient, nullptr);
    double largest = 0.0;
    for (const double g : gradient) largest = std::max(largest, std::abs(g));
    // Cut: Level I does not depend on PI nodes, so its minimum is unchanged. Keep: the PI nodes
    // have moved.
    if (boundary_edges == BoundaryEdges::kCut) {
      EXPECT_LT(largest, 1e-3);
    } else {
      EXPECT_GT(largest, 1e-3);
    }
  }
}

TEST(TwoLevelStrategy, MovesNothingWhereNothingIsSeen) {
  TestProblemOptions options = HalfSeen(false, 4);
  options.observed_columns = 0;
  for (const LinearSolver linear_solver : kLinearSolvers) {
    const StripBuilder strip(options);
    DeformationState state(18);
    const SolveSummary summary =
        Make(SolveMode::kTwoLevel, linear_solver, 2)->Solve(strip.builder, {}, &state);
    EXPECT_EQ(summary.status, SolveStatus::kConverged);
    EXPECT_EQ(summary.levels[0].num_variable_nodes, 0);
    EXPECT_EQ(AllParameters(state), AllParameters(DeformationState(18)));
  }
}

// ceres::Solve sums the cost per thread, and the last bits of the cost affect the state through the
// trust region.
TEST(Strategy, GivesTheSameOnOneThreadAndOnTwo) {
  TestProblemOptions options;
  options.columns = 16;
  options.rows = 6;
  options.points_per_cell = 6;
  options.observed_columns = 8;
  options.has_camera = true;
  options.target_deviation = 0.1;
  StripBuilder strip(options, "point_to_plane");
  strip.builder.SetLoss(strip.data, {LossType::kHuber, 0.05});
  for (const LinearSolver linear_solver : kLinearSolvers) {
    for (const SolveMode mode : kModes) {
      std::vector<double> first;
      for (const int threads : {1, 2, 2, 1}) {
        SolverOptions solver;
        solver.num_threads = threads;
        DeformationState state(strip.problem.graph.num_nodes());
        Make(mode, linear_solver, 1)->Solve(strip.builder, solver, &state);
        const std::vector<double> found = AllParameters(state);
        if (first.empty()) first = found;
        if (linear_solver == LinearSolver::kBlock || threads == 1) {
          EXPECT_EQ(found, first) << threads << " threads";
        }
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], first[i], 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace ceres_ed
