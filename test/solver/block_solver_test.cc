// Compares the block solver with Ceres, and its parts with dense linear algebra.
#include <ceres_ed/solver/normal_equations/loss_correction.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/solver/assembly.h>

namespace ceres_ed {
namespace {

// For any loss, the corrected residuals have the gradient rho' J^T r of the robust cost; with rho''
// > 0 the matrix also has Triggs' second-order term.
TEST(LossCorrection, HasTheGradientAndTriggsMatrixOfTheRobustCost) {
  constexpr int kRows = 3;
  constexpr int kColumns = 4;
  using RowMajor = Eigen::Matrix<double, kRows, kColumns, Eigen::RowMajor>;
  const RowMajor J = (RowMajor() << 1, 2, -1, 0.5, 0, 3, 1, -2, 0.7, -1, 2, 1).finished();
  const Eigen::Vector3d r(0.3, -0.2, 0.4);
  const double s = r.squaredNorm();
  for (const double rho2 : {-0.5, 0.0, 0.8}) {
    const double rho[3] = {1.0, 0.6, rho2};
    RowMajor corrected_J = J;
    Eigen::Vector3d corrected_r = r;
    const LossCorrection correction(s, rho);
    correction.CorrectJacobian(corrected_r.data(), kRows, kColumns, corrected_J.data());
    correction.CorrectResiduals(kRows, corrected_r.data());
    EXPECT_LT((corrected_J.transpose() * corrected_r - rho[1] * J.transpose() * r).norm(), 1e-14);
    const Eigen::Vector4d g = J.transpose() * r;
    const Eigen::Matrix4d H =
        rho[1] * J.transpose() * J + 2.0 * std::max(0.0, rho2) * g * g.transpose();
    EXPECT_LT((corrected_J.transpose() * corrected_J - H).norm(), 1e-13) << "rho'' = " << rho2;
  }
}

SolverOptions Converging() {
  SolverOptions options;
  options.max_iterations = 200;
  options.function_tolerance = 1e-15;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  return options;
}

TEST(BlockSolver, ReachesTheMinimumOfCeres) {
  for (const bool has_camera : {false, true}) {
    const TestProblem problem = MakeProblem(has_camera);
    for (const LossType type : {LossType::kSquared, LossType::kHuber, LossType::kGemanMcClure}) {
      const auto builder = MakeBuilder(problem, {type, 0.3});
      for (const SolveMode mode : {SolveMode::kBatch, SolveMode::kTwoLevel}) {
        StrategyOptions options;
        options.mode = mode;
        std::vector<double> energies;
        for (const LinearSolver solver : {LinearSolver::kCeres, LinearSolver::kBlock}) {
          options.linear_solver = solver;
          DeformationState state(problem.graph.num_nodes());
          const SolveSummary summary = MakeStrategy(options)->Solve(*builder, Converging(), &state);
          ASSERT_TRUE(summary.IsUsable()) << summary.message;
          EXPECT_LT(summary.final_energy, summary.initial_energy);
          energies.push_back(summary.final_energy);
        }
        EXPECT_NEAR(energies[1], energies[0], 1e-9 * energies[0])
            << NameOf(type) << (has_camera ? " with" : " without") << " camera";
      }
    }
  }
}

// The forcing terms are those of the solver: nothing is asked of it but the tolerances of a solve.
TEST(GradientSolver, ReachesTheMinimumOfTheFactorWithEveryPreconditioner) {
  for (const bool has_camera : {false, true}) {
    const TestProblem problem = MakeProblem(has_camera);
    const auto builder = MakeBuilder(problem, {LossType::kHuber, 0.3});
    for (const SolveMode mode : {SolveMode::kBatch, SolveMode::kTwoLevel, SolveMode::kMarginal}) {
      StrategyOptions options;
      options.mode = mode;
      DeformationState expected(problem.graph.num_nodes());
      const double energy =
          MakeStrategy(options)->Solve(*builder, Converging(), &expected).final_energy;
      options.linear_solver = LinearSolver::kPcg;
      for (const auto& [name, preconditioner] : NamesOf(PreconditionerKind())) {
        options.preconditioner = preconditioner;
        DeformationState state(problem.graph.num_nodes());
        const SolveSummary summary = MakeStrategy(options)->Solve(*builder, Converging(), &state);
        ASSERT_TRUE(summary.IsUsable()) << summary.message;
        EXPECT_NEAR(summary.final_energy, energy, 1e-8 * energy)
            << name << ' ' << NameOf(mode) << (has_camera ? " with" : " without") << " camera";
      }
    }
  }
}

TEST(GradientSolver, HasTheSameBitsAtAnyNumberOfThreads) {
  const TestProblem problem = MakeProblem(/*has_camera=*/true);
  const auto builder = MakeBuilder(problem, {});
  StrategyOptions options;
  options.linear_solver = LinearSolver::kPcg;
  for (const auto& [name, preconditioner] : NamesOf(PreconditionerKind())) {
    options.preconditioner = preconditioner;
    std::vector<std::vector<double>> results;
    for (const int num_threads : {1, 3}) {
      SolverOptions solver_options;
      solver_options.num_threads = num_threads;
      DeformationState state(problem.graph.num_nodes());
      ASSERT_TRUE(MakeStrategy(options)->Solve(*builder, solver_options, &state).IsUsable());
      results.push_back(AllParameters(state));
    }
    EXPECT_EQ(results[0], results[1]) << name;
  }
}

// With points on few nodes they keep dual unknowns, which conjugate gradients never form.
TEST(GradientSolver, SolvesWithDualUnknowns) {
  TestProblemOptions problem_options;
  problem_options.columns = 14;
  problem_options.rows = 9;
  problem_options.observed_columns = 1;
  problem_options.target_deviation = 0.2;
  const TestProblem problem = MakeTestProblem(problem_options);
  const auto builder = MakeBuilder(problem, {});
  ProblemConfig config;
  config.variable_nodes.assign(problem.graph.num_nodes(), 1);
  NormalEquations equations;
  equations.Build(*builder, config, DualResiduals::kWhereTheyPay);
  ASSERT_GT(equations.num_dual(), 0) << "the problem is not one of few points";
  StrategyOptions options;
  DeformationState expected(problem.graph.num_nodes());
  const double energy =
      MakeStrategy(options)->Solve(*builder, Converging(), &expected).final_energy;
  options.linear_solver = LinearSolver::kPcg;
  DeformationState state(problem.graph.num_nodes());
  const SolveSummary summary = MakeStrategy(options)->Solve(*builder, Converging(), &state);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_NEAR(summary.final_energy, energy, 1e-8 * energy);
}

TEST(CeresCgnr, ReachesTheMinimumOfTheFactor) {
  const TestProblem problem = MakeProblem(/*has_camera=*/false);
  const auto builder = MakeBuilder(problem, {});
  std::vector<double> energies;
  for (const LinearSolver solver : {LinearSolver::kCeres, LinearSolver::kCeresCgnr}) {
    StrategyOptions options;
    options.linear_solver = solver;
    DeformationState state(problem.graph.num_nodes());
    energies.push_back(MakeStrategy(options)->Solve(*builder, Converging(), &state).final_energy);
  }
  EXPECT_NEAR(energies[1], energies[0], 1e-8 * energies[0]);
}

// One object solves a changing problem: new correspondences, other variable nodes, a larger graph.
TEST(BlockSolver, ForgetsNothingAndKeepsNothingStale) {
  StrategyOptions options;
  options.mode = SolveMode::kTwoLevel;
  const std::unique_ptr<Strategy> reused = MakeStrategy(options);
  for (const int observed : {2, 4, 3, 6}) {
    TestProblemOptions problem_options;
    problem_options.columns = observed == 6 ? 9 : 7;
    problem_options.observed_columns = observed;
    problem_options.target_deviation = 0.1;
    const TestProblem problem = MakeTestProblem(problem_options);
    const auto builder = MakeBuilder(problem, {});
    DeformationState with_reused(problem.graph.num_nodes());
    DeformationState with_fresh(problem.graph.num_nodes());
    const double reused_energy = reused->Solve(*builder, Converging(), &with_reused).final_energy;
    const double fresh_energy =
        MakeStrategy(options)->Solve(*builder, Converging(), &with_fresh).final_energy;
    EXPECT_NEAR(reused_energy, fresh_energy, 1e-9 * fresh_energy) << observed;
  }
}

}  // namespace
}  // namespace ceres_ed
