// The block solver against Ceres, and its parts against dense linear algebra.
#include <ceres_ed/energy/builtin_energies.h>
#include <ceres_ed/solver/loss_correction.h>
#include <ceres_ed/solver/normal_equations.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/solver/dense_matrix.h>

namespace ceres_ed {
namespace {

// All energies of a test problem, each with its weight and loss.
std::unique_ptr<ProblemBuilder> MakeBuilder(const TestProblem& problem, const LossSpec& loss) {
  EnergyRegistry registry;
  RegisterBuiltinEnergies(&registry);
  auto builder = std::make_unique<ProblemBuilder>(problem.graph, problem.has_camera);
  const EnergyContext context = problem.Context();
  const auto add = [&](const char* name, double weight, const LossSpec& term_loss) {
    const StatusOr<std::unique_ptr<EnergyTerm>> energy = registry.Create(name, {});
    ASSERT_TRUE(energy.ok()) << energy.status().message();
    const int term = builder->AddTerm(name, (*energy)->kind(), weight, term_loss);
    builder->CollectResiduals(term, **energy, context);
  };
  add("rotation", 1.0, {});
  add("regularization", 10.0, {});
  add("point_to_plane", 50.0, loss);
  add("point_to_point", 5.0, loss);
  add("landmark", 2.0, {});
  if (problem.has_camera) add("pose_prior", 0.1, {});
  return builder;
}

TestProblem MakeProblem(bool has_camera) {
  TestProblemOptions options;
  options.columns = 7;
  options.rows = 4;
  options.points_per_cell = 3;
  options.observed_columns = 3;
  options.has_camera = has_camera;
  options.target_deviation = 0.1;
  return MakeTestProblem(options);
}

struct Assembled {
  double cost = 0.0;
  Eigen::MatrixXd H;
  Eigen::VectorXd gradient;
};

Assembled AssembleInBlocks(const ProblemBuilder& builder,
                           const ProblemConfig& config,
                           const DeformationState& state,
                           int num_threads) {
  NormalEquations equations(builder, config);
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  EXPECT_TRUE(equations.SetStructure(&structure));
  Assembled assembled;
  std::vector<double> values;
  EXPECT_TRUE(
      equations.Evaluate(state, num_threads, &assembled.cost, &values, &assembled.gradient));
  assembled.H = DenseOf(structure, values);
  return assembled;
}

// The same from ceres::Problem::Evaluate, variable nodes in order, then rotation and translation.
Assembled AssembleWithCeres(const ProblemBuilder& builder,
                            const ProblemConfig& config,
                            DeformationState* state) {
  const BuiltProblem built = builder.Build(config, state);
  ceres::Problem::EvaluateOptions options;
  for (int j = 0; j < state->num_nodes(); ++j) {
    if (config.variable_nodes[j] != 0) options.parameter_blocks.push_back(state->node(j));
  }
  if (config.camera_variable) {
    options.parameter_blocks.push_back(state->camera_from_map.rotation.coeffs().data());
    options.parameter_blocks.push_back(state->camera_from_map.translation.data());
  }
  Assembled assembled;
  ceres::CRSMatrix crs;
  std::vector<double> gradient;
  EXPECT_TRUE(built.problem->Evaluate(options, &assembled.cost, nullptr, &gradient, &crs));
  const Eigen::MatrixXd J = DenseOf(crs);
  assembled.H = J.transpose() * J;
  assembled.gradient = Eigen::Map<Eigen::VectorXd>(gradient.data(), gradient.size());
  return assembled;
}

void ExpectClose(const Assembled& blocks, const Assembled& ceres) {
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(blocks.cost, ceres.cost, kRounding * ceres.cost);
  ASSERT_EQ(blocks.H.rows(), ceres.H.rows());
  EXPECT_LT((blocks.H - ceres.H).norm(), kRounding * ceres.H.norm());
  EXPECT_LT((blocks.gradient - ceres.gradient).norm(), kRounding * ceres.gradient.norm());
}

TEST(NormalEquations, AgreeWithCeres) {
  for (const bool has_camera : {false, true}) {
    const TestProblem problem = MakeProblem(has_camera);
    for (const LossType type : {LossType::kSquared, LossType::kHuber, LossType::kWelsch}) {
      const auto builder = MakeBuilder(problem, {type, 0.05});
      DeformationState state = RandomState(problem, 0.1, 5);
      const std::vector<char> relevant = builder->PointRelevantNodes();
      for (const ProblemConfig& config :
           {FullConfig(state.num_nodes(), has_camera),
            LevelOneConfig(problem.graph, relevant, has_camera, SeamEdges::kKeep, 1),
            LevelOneConfig(problem.graph, relevant, has_camera, SeamEdges::kCut, 0),
            LevelTwoConfig(relevant)}) {
        ExpectClose(AssembleInBlocks(*builder, config, state, 1),
                    AssembleWithCeres(*builder, config, &state));
      }
    }
  }
}

// Of 6 x 3 nodes the first two columns of cells are seen: their nodes share points. All others
// share edges alone.
TEST(NormalEquations, KnowWhichPairsShareTranslationsAlone) {
  TestProblemOptions options;
  options.observed_columns = 2;
  const StripBuilder strip(options);
  NormalEquations equations(strip.builder, FullConfig(18, false));
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  ASSERT_TRUE(equations.SetStructure(&structure));
  double cost = 0.0;
  std::vector<double> values;
  Eigen::VectorXd gradient;
  const DeformationState state = RandomState(strip.problem, 0.1, 5);
  ASSERT_TRUE(equations.Evaluate(state, 1, &cost, &values, &gradient));
  for (int j = 0; j < structure.num_blocks(); ++j) {
    for (int e = structure.column_begin(j); e < structure.column_begin(j + 1); ++e) {
      const int row = structure.entry_row(e);
      EXPECT_EQ(structure.affine_pair(e), row == j || row < 9) << row << ", " << j;
      const Eigen::Map<const Eigen::Matrix<double, kNodeSize, kNodeSize>> block(
          &values[structure.value_offset(e)]);
      EXPECT_EQ((block.topLeftCorner<9, 9>().isZero(0.0)), !structure.affine_pair(e));
      EXPECT_FALSE(block.isZero(0.0));
    }
  }
}

TEST(NormalEquations, RefuseAStructureThatLacksAnAffinePair) {
  TestProblemOptions options;
  options.observed_columns = 2;
  const StripBuilder strip(options);
  NormalEquations equations(strip.builder, FullConfig(18, false));
  std::vector<BlockPair> pairs = equations.BlockPairs();
  ASSERT_TRUE(pairs.front().affine_pair);
  pairs.front().affine_pair = false;
  const BlockStructure structure(equations.BlockSizes(), pairs);
  EXPECT_FALSE(equations.SetStructure(&structure));
}

TEST(BlockStructure, JoinsRepeatedPairs) {
  const BlockStructure structure(
      {2, 3, 2}, {{0, 2, false}, {1, 0, false}, {2, 0, false}, {0, 1, true}, {2, 0, false}});
  const std::vector<BlockPair> expected{{1, 0, true}, {2, 0, false}};
  EXPECT_EQ(structure.Pairs(), expected);
  EXPECT_EQ(structure.num_entries(), 5);
  EXPECT_TRUE(structure.affine_pair(structure.FindEntry(2, 2)));
  EXPECT_EQ(structure.num_values(), 4u + 6u + 4u + 9u + 4u);
}

TEST(NormalEquations, AreTheSameBitsOnAnyNumberOfThreads) {
  const TestProblem problem = MakeProblem(true);
  const auto builder = MakeBuilder(problem, {LossType::kWelsch, 0.05});
  const DeformationState state = RandomState(problem, 0.1, 5);
  const ProblemConfig config = FullConfig(state.num_nodes(), true);
  const Assembled one = AssembleInBlocks(*builder, config, state, 1);
  for (const int threads : {2, 3}) {
    const Assembled many = AssembleInBlocks(*builder, config, state, threads);
    EXPECT_EQ(one.cost, many.cost);
    EXPECT_EQ(one.H, many.H);
    EXPECT_EQ(one.gradient, many.gradient);
  }
}

// Whatever the loss, the corrected residuals have the gradient rho' J^T r of the robust cost; with
// rho'' > 0 the matrix has Triggs' second-order term as well.
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
            << LossTypeName(type) << (has_camera ? " with" : " without") << " camera";
      }
    }
  }
}

// One object on a changing problem: new correspondences, other variable nodes, a larger graph.
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
