// Compares the normal equations with those of Ceres.
#include "ceres_ed/solver/normal_equations/normal_equations.h"

#include <ceres_ed/linear_algebra/block_cholesky.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/solver/assembly.h>

namespace ceres_ed {
namespace {

// Returns a problem with enough points and nodes for more than one task.
TestProblem MakeLargeProblem(bool has_camera) {
  TestProblemOptions options;
  options.columns = 6;
  options.rows = 4;
  options.points_per_cell = 70;
  options.observed_columns = 4;
  options.has_camera = has_camera;
  options.target_deviation = 0.1;
  return MakeTestProblem(options);
}

// Reverses the node order of every third point, and binds some points to fewer nodes.
void MixBindings(TestProblem* problem) {
  for (std::size_t i = 0; i < problem->points.size(); ++i) {
    const Binding binding = problem->skinning[i];
    std::vector<int> nodes(binding.nodes, binding.nodes + binding.size);
    std::vector<double> weights(binding.weights, binding.weights + binding.size);
    if (i % 3 == 0) {
      std::reverse(nodes.begin(), nodes.end());
      std::reverse(weights.begin(), weights.end());
    }
    const int size = i % 7 == 0 ? 2 : binding.size;
    problem->skinning.Set(i, nodes.data(), weights.data(), size);
  }
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
            LevelOneConfig(problem.graph, relevant, has_camera, BoundaryEdges::kKeep, 1),
            LevelOneConfig(problem.graph, relevant, has_camera, BoundaryEdges::kCut, 0),
            LevelTwoConfig(relevant)}) {
        ExpectClose(AssembleInBlocks(*builder, config, state, 1),
                    AssembleWithCeres(*builder, config, &state));
      }
    }
  }
}

// On 6 x 3 nodes, the first two columns of cells are observed, so that their nodes share points.
// All other nodes share only edges.
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
      EXPECT_EQ(structure.head_pair(e), row == j || row < 9) << row << ", " << j;
      const Eigen::Map<const Eigen::Matrix<double, kNodeSize, kNodeSize>> block(
          &values[structure.value_offset(e)]);
      EXPECT_EQ((block.topLeftCorner<9, 9>().isZero(0.0)), !structure.head_pair(e));
      EXPECT_FALSE(block.isZero(0.0));
    }
  }
}

// Points on 7 x 4 nodes, few enough to get dual unknowns, and their equations.
struct DualEquations {
  DualEquations() : problem(MakeTestProblem(Options())), builder(MakeBuilder(problem, kHuber)) {
    config = FullConfig(problem.graph.num_nodes(), false);
    state = RandomState(problem, 0.1, 5);
    equations.Build(*builder, config, DualResiduals::kWhereTheyPay);
    structure = std::make_unique<BlockStructure>(
        equations.BlockSizes(), equations.BlockPairs(), equations.num_dual());
    EXPECT_TRUE(equations.SetStructure(structure.get()));
    EXPECT_TRUE(equations.Evaluate(state, 2, &assembled.cost, &values, &assembled.gradient));
  }

  static TestProblemOptions Options() {
    TestProblemOptions options;
    options.columns = 7;
    options.rows = 4;
    options.target_deviation = 0.1;
    return options;
  }

  static constexpr LossSpec kHuber{LossType::kHuber, 0.05};
  TestProblem problem;
  std::unique_ptr<ProblemBuilder> builder;
  ProblemConfig config;
  DeformationState state;
  NormalEquations equations;
  std::unique_ptr<BlockStructure> structure;
  std::vector<double> values;
  Assembled assembled;
};

TEST(NormalEquations, AreThoseOfAllPointsOnceDualUnknownsAreEliminated) {
  DualEquations dual;
  ASSERT_EQ(dual.equations.num_dual(), static_cast<int>(dual.problem.points.size()));
  const Eigen::Index n = dual.structure->num_primal_rows();
  const Eigen::Index num_dual = dual.structure->num_rows() - n;
  const Eigen::MatrixXd K = DenseOf(*dual.structure, dual.values);
  EXPECT_EQ(K.bottomRightCorner(num_dual, num_dual),
            -Eigen::MatrixXd::Identity(num_dual, num_dual));
  EXPECT_TRUE(dual.assembled.gradient.tail(num_dual).isZero(0.0));
  const Eigen::MatrixXd J = K.bottomLeftCorner(num_dual, n);
  dual.assembled.H = K.topLeftCorner(n, n) + J.transpose() * J;
  dual.assembled.gradient.conservativeResize(n);
  ExpectClose(dual.assembled, AssembleWithCeres(*dual.builder, dual.config, &dual.state));
  const Eigen::VectorXd diagonal = dual.structure->Diagonal(dual.values).head(n);
  EXPECT_LT((diagonal - dual.assembled.H.diagonal()).norm(), 1e-12 * diagonal.norm());
}

TEST(NormalEquations, WithDualUnknownsAreSolvedAsWellAsWithout) {
  DualEquations dual;
  const BlockStructure& structure = *dual.structure;
  const Eigen::Index n = structure.num_primal_rows();
  Eigen::VectorXd damping = Eigen::VectorXd::Zero(structure.num_rows());
  damping.head(n) = 1e-13 * structure.Diagonal(dual.values).head(n);
  BlockCholesky cholesky(structure);
  ASSERT_TRUE(cholesky.Factorize(dual.values.data(), damping));
  const Eigen::VectorXd step = cholesky.Solve(dual.assembled.gradient).head(n);
  const Eigen::MatrixXd H = AssembleWithCeres(*dual.builder, dual.config, &dual.state).H;
  const Eigen::VectorXd g = dual.assembled.gradient.head(n);
  EXPECT_LT((H * step - g).norm(), 1e-10 * g.norm());
}

TEST(NormalEquations, RefuseAStructureThatLacksAnAffinePair) {
  TestProblemOptions options;
  options.observed_columns = 2;
  const StripBuilder strip(options);
  NormalEquations equations(strip.builder, FullConfig(18, false));
  std::vector<BlockPair> pairs = equations.BlockPairs();
  ASSERT_TRUE(pairs.front().head_pair);
  pairs.front().head_pair = false;
  const BlockStructure structure(equations.BlockSizes(), pairs);
  EXPECT_FALSE(equations.SetStructure(&structure));
}

TEST(BlockStructure, JoinsRepeatedPairs) {
  const BlockStructure structure(
      {2, 3, 2}, {{0, 2, false}, {1, 0, false}, {2, 0, false}, {0, 1, true}, {2, 0, false}});
  const std::vector<BlockPair> expected{{1, 0, true}, {2, 0, false}};
  EXPECT_EQ(structure.Pairs(), expected);
  EXPECT_EQ(structure.num_entries(), 5);
  EXPECT_TRUE(structure.head_pair(structure.FindEntry(2, 2)));
  EXPECT_EQ(structure.num_values(), 4u + 6u + 4u + 9u + 4u);
}

TEST(NormalEquations, AgreeWithCeresWhereThereAreManyPointsOfMixedBindings) {
  for (const bool has_camera : {false, true}) {
    TestProblem problem = MakeLargeProblem(has_camera);
    MixBindings(&problem);
    const auto builder = MakeBuilder(problem, {LossType::kHuber, 0.05});
    DeformationState state = RandomState(problem, 0.1, 5);
    for (const ProblemConfig& config :
         {FullConfig(state.num_nodes(), has_camera),
          LevelOneConfig(
              problem.graph, builder->PointRelevantNodes(), has_camera, BoundaryEdges::kKeep, 1)}) {
      ExpectClose(AssembleInBlocks(*builder, config, state, 2),
                  AssembleWithCeres(*builder, config, &state));
    }
  }
}

// The camera is variable and all nodes are held.
TEST(NormalEquations, AgreeWithCeresOnTheCameraAlone) {
  const TestProblem problem = MakeProblem(true);
  const auto builder = MakeBuilder(problem, {LossType::kWelsch, 0.05});
  DeformationState state = RandomState(problem, 0.1, 5);
  ProblemConfig config = FullConfig(state.num_nodes(), true);
  std::fill(config.variable_nodes.begin(), config.variable_nodes.end(), 0);
  ExpectClose(AssembleInBlocks(*builder, config, state, 1),
              AssembleWithCeres(*builder, config, &state));
}

TEST(NormalEquations, AgreeWithCeresOnRobustPriors) {
  const TestProblem problem = MakeProblem(true);
  const auto builder = MakeBuilder(problem, {LossType::kHuber, 0.05});
  for (int term = 0; term < 2; ++term) builder->SetLoss(term, {LossType::kCauchy, 0.1});
  DeformationState state = RandomState(problem, 0.1, 5);
  const ProblemConfig config = FullConfig(state.num_nodes(), true);
  ExpectClose(AssembleInBlocks(*builder, config, state, 1),
              AssembleWithCeres(*builder, config, &state));
}

// Equations that are built again on the same object for another problem equal those of a new
// object.
TEST(NormalEquations, KeepNothingOfAnEarlierProblem) {
  const TestProblem large = MakeLargeProblem(true);
  const TestProblem small = MakeProblem(false);
  const auto large_builder = MakeBuilder(large, {LossType::kHuber, 0.05});
  const auto small_builder = MakeBuilder(small, {});
  const DeformationState state = RandomState(small, 0.1, 5);
  const ProblemConfig config = FullConfig(state.num_nodes(), false);
  NormalEquations equations(*large_builder, FullConfig(large.graph.num_nodes(), true));
  equations.Build(*small_builder, config);
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  ASSERT_TRUE(equations.SetStructure(&structure));
  double cost = 0.0;
  std::vector<double> values;
  Eigen::VectorXd gradient;
  ASSERT_TRUE(equations.Evaluate(state, 1, &cost, &values, &gradient));
  const Assembled fresh = AssembleInBlocks(*small_builder, config, state, 1);
  EXPECT_EQ(cost, fresh.cost);
  EXPECT_EQ(gradient, fresh.gradient);
  EXPECT_EQ(DenseOf(structure, values), fresh.H);
}

TEST(NormalEquations, AreTheSameBitsOnAnyNumberOfThreads) {
  const TestProblem problem = MakeLargeProblem(true);
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

}  // namespace
}  // namespace ceres_ed
