// Tests how solves end.
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/residual_collection.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

// A cost that fails (or returns NaN) if t_j of its node is not zero, or everywhere.
class FragileCost final : public ceres::CostFunction {
 public:
  FragileCost(bool everywhere, bool not_a_number)
      : everywhere_(everywhere), not_a_number_(not_a_number) {
    set_num_residuals(1);
    mutable_parameter_block_sizes()->push_back(kNodeSize);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const bool breaks = everywhere_ || !NodeTranslation(parameters[0]).isZero(0.0);
    if (breaks && !not_a_number_) return false;
    residuals[0] = breaks ? std::nan("") : 0.0;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      for (int i = 0; i < kNodeSize; ++i) jacobians[0][i] = 0.0;
    }
    return true;
  }

 private:
  bool everywhere_;
  bool not_a_number_;
};

class FragileEnergy final : public EnergyTerm {
 public:
  FragileEnergy(int node, bool everywhere, bool not_a_number)
      : node_(node), everywhere_(everywhere), not_a_number_(not_a_number) {}
  EnergyKind kind() const override { return EnergyKind::kPrior; }
  void AddResiduals(const EnergyContext&, ResidualSink* sink) const override {
    const BlockRef block = BlockRef::Node(node_);
    sink->Add(std::make_unique<FragileCost>(everywhere_, not_a_number_), &block, 1);
  }

 private:
  int node_;
  bool everywhere_;
  bool not_a_number_;
};

TestProblemOptions FarFromTargets() {
  TestProblemOptions options = HalfSeen(/*has_camera=*/false, 4);
  options.target_deviation = 0.3;
  return options;
}

using Case = std::tuple<SolveMode, LinearSolver>;

std::string ModeName(SolveMode mode) {
  if (mode == SolveMode::kBatch) return "Batch";
  return mode == SolveMode::kTwoLevel ? "TwoLevel" : "Marginal";
}

std::string SolverName(LinearSolver linear_solver) {
  if (linear_solver == LinearSolver::kCeres) return "Ceres";
  return linear_solver == LinearSolver::kBlock ? "Block" : "Pcg";
}

class StrategyStatus : public ::testing::TestWithParam<Case> {
 protected:
  SolveSummary Solve(const SolverOptions& options) {
    StrategyOptions strategy;
    std::tie(strategy.mode, strategy.linear_solver) = GetParam();
    strategy.rings = 0;
    return MakeStrategy(strategy)->Solve(strip_.builder, options, &state_);
  }

  void AddFragileEnergy(int node, bool everywhere, bool not_a_number) {
    const int term = strip_.builder.AddTerm("fragile", EnergyKind::kPrior);
    strip_.builder.CollectResiduals(
        term, FragileEnergy(node, everywhere, not_a_number), strip_.problem.Context());
  }

  StripBuilder strip_{FarFromTargets()};
  DeformationState state_{18};
};

TEST_P(StrategyStatus, IsConvergedAtTheMinimum) {
  const SolveSummary summary = Solve({});
  EXPECT_EQ(summary.status, SolveStatus::kConverged) << summary.message;
  EXPECT_NE(summary.message, "");
  EXPECT_NE(summary.message, "not solved");
}

TEST_P(StrategyStatus, IsMaxIterationsAfterThatMany) {
  SolverOptions options;
  options.max_iterations = 2;
  options.function_tolerance = 0.0;
  const SolveSummary summary = Solve(options);
  EXPECT_EQ(summary.status, SolveStatus::kMaxIterations);
  EXPECT_TRUE(summary.IsUsable());
  for (const LevelSummary& level : summary.levels) EXPECT_EQ(level.iterations, 2);
  EXPECT_LT(summary.final_energy, summary.initial_energy);
}

TEST_P(StrategyStatus, StaysAtTheStartWithoutIterations) {
  SolverOptions options;
  options.max_iterations = 0;
  const SolveSummary summary = Solve(options);
  EXPECT_EQ(summary.status, SolveStatus::kMaxIterations);
  EXPECT_EQ(summary.TotalIterations(), 0);
  EXPECT_EQ(summary.final_energy, summary.initial_energy);
  EXPECT_EQ(AllParameters(state_), AllParameters(DeformationState(18)));
}

TEST_P(StrategyStatus, IsTimeLimitWhenTimeIsUp) {
  SolverOptions options;
  options.time_limit_s = 1e-9;
  const SolveSummary summary = Solve(options);
  EXPECT_EQ(summary.status, SolveStatus::kTimeLimit) << summary.message;
  EXPECT_TRUE(summary.IsUsable());
  EXPECT_LE(summary.final_energy, summary.initial_energy);
}

TEST_P(StrategyStatus, IsInterruptedWithTheStateImproved) {
  SolverOptions options;
  int calls = 0;
  options.should_stop = [&calls] { return ++calls >= 2; };
  const SolveSummary summary = Solve(options);
  EXPECT_EQ(summary.status, SolveStatus::kInterrupted) << summary.message;
  EXPECT_EQ(summary.levels[0].iterations, 1);
  EXPECT_LT(summary.final_energy, 0.8 * summary.initial_energy);
}

TEST_P(StrategyStatus, IsInterruptedAtOnceWithTheStateAsItWas) {
  SolverOptions options;
  options.should_stop = [] { return true; };
  const SolveSummary summary = Solve(options);
  EXPECT_EQ(summary.status, SolveStatus::kInterrupted) << summary.message;
  EXPECT_EQ(summary.TotalIterations(), 0);
  EXPECT_EQ(AllParameters(state_), AllParameters(DeformationState(18)));
}

TEST_P(StrategyStatus, IsFailedWhereACostFailsAtTheStart) {
  for (const bool not_a_number : {false, true}) {
    AddFragileEnergy(0, true, not_a_number);
    const SolveSummary summary = Solve({});
    EXPECT_EQ(summary.status, SolveStatus::kFailed);
    EXPECT_NE(summary.message, "");
    EXPECT_FALSE(summary.IsUsable());
    EXPECT_EQ(AllParameters(state_), AllParameters(DeformationState(18)));
  }
}

TEST_P(StrategyStatus, LeavesTheStateAsItWasWhereACostFailsAtEveryStep) {
  for (const bool not_a_number : {false, true}) {
    AddFragileEnergy(0, false, not_a_number);
    const SolveSummary summary = Solve({});
    // ceres::Solve reduces the step until it vanishes, and reports convergence.
    if (std::get<1>(GetParam()) != LinearSolver::kCeres) {
      EXPECT_EQ(summary.status, SolveStatus::kFailed);
    }
    EXPECT_EQ(AllParameters(state_), AllParameters(DeformationState(18)));
  }
}

// Node 17 is PI: only Level II evaluates its cost, after Level I has moved the PR nodes.
TEST_P(StrategyStatus, LeavesTheStateAsItWasWhereACostOfAPointIrrelevantNodeFails) {
  AddFragileEnergy(17, true, false);
  const SolveSummary summary = Solve({});
  EXPECT_EQ(summary.status, SolveStatus::kFailed);
  EXPECT_EQ(AllParameters(state_), AllParameters(DeformationState(18)));
}

INSTANTIATE_TEST_SUITE_P(
    All,
    StrategyStatus,
    ::testing::Combine(
        ::testing::Values(SolveMode::kBatch, SolveMode::kTwoLevel, SolveMode::kMarginal),
        ::testing::Values(LinearSolver::kCeres, LinearSolver::kBlock, LinearSolver::kPcg)),
    [](const ::testing::TestParamInfo<Case>& info) {
      return ModeName(std::get<0>(info.param)) + SolverName(std::get<1>(info.param));
    });

// The boundary would tear if Level II had no time left.
TEST(TwoLevelStrategy, LetsPointIrrelevantNodesFollowWhenLevelOneRunsOutOfTime) {
  for (const LinearSolver linear_solver : {LinearSolver::kCeres, LinearSolver::kBlock}) {
    const StripBuilder strip(FarFromTargets());
    StrategyOptions strategy;
    strategy.mode = SolveMode::kTwoLevel;
    strategy.rings = 0;
    strategy.boundary_edges = BoundaryEdges::kCut;
    strategy.linear_solver = linear_solver;
    SolverOptions options;
    options.function_tolerance = 0.0;
    options.time_limit_s = 0.2;
    // Level I ends after about four steps.
    options.should_stop = [] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      return false;
    };
    DeformationState state(18);
    const SolveSummary summary = MakeStrategy(strategy)->Solve(strip.builder, options, &state);
    EXPECT_EQ(summary.status, SolveStatus::kTimeLimit) << summary.message;
    ASSERT_EQ(summary.levels.size(), 2u);
    ASSERT_GT(summary.levels[0].iterations, 0);
    EXPECT_GT(summary.levels[1].iterations, 0);
    EXPECT_LE(summary.levels[1].iterations, 3);
    EXPECT_LT(summary.levels[1].final_cost, 0.5 * summary.levels[1].initial_cost);
    EXPECT_LT(summary.final_energy, summary.initial_energy);
  }
}

}  // namespace
}  // namespace ceres_ed
