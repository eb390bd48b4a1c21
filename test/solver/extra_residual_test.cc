// Tests a prior that replaces eliminated nodes, in the problems of both level solvers.
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <vector>

#include <Eigen/Core>
#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>
#include <test/linear_algebra/dense_matrix.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

// Six columns of three nodes. The first three columns are PR, and the last two are eliminated.
class ExtraResidualTest : public ::testing::Test {
 protected:
  static TestProblemOptions Options() {
    TestProblemOptions options;
    options.observed_columns = 2;
    options.points_per_cell = 4;
    options.has_camera = true;
    options.target_deviation = 0.1;
    return options;
  }

  ExtraResidualTest() {
    ProblemConfig eliminated;
    eliminated.variable_nodes.assign(18, 0);
    for (int j = 12; j < 18; ++j) eliminated.variable_nodes[j] = 1;
    CHECK(marginalization_.SetProblem(strip_.builder, eliminated).ok());
    CHECK(marginalization_.Linearize(state_, 1) && marginalization_.Eliminate(0.0));
    config_ = FullConfig(18, true);
    config_.eliminated_nodes = eliminated.variable_nodes;
    for (int j = 12; j < 18; ++j) config_.variable_nodes[j] = 0;
    config_.extra_residuals = {marginalization_.PriorResidual()};
    // The prior is evaluated away from its linearisation point.
    moved_ = RandomState(strip_.problem, 0.1, 8);
  }

  // Returns cost, gradient and Gauss-Newton matrix from ceres::Problem: nodes in order, then the
  // camera.
  double AssembleWithCeres(Eigen::VectorXd* gradient, Eigen::MatrixXd* H) {
    const BuiltProblem built = strip_.builder.Build(config_, &moved_);
    ceres::Problem::EvaluateOptions options;
    for (int j = 0; j < 18; ++j) {
      if (config_.variable_nodes[j] != 0) options.parameter_blocks.push_back(moved_.node(j));
    }
    options.parameter_blocks.push_back(moved_.camera_from_map.rotation.coeffs().data());
    options.parameter_blocks.push_back(moved_.camera_from_map.translation.data());
    double cost = 0.0;
    ceres::CRSMatrix crs;
    std::vector<double> g;
    EXPECT_TRUE(built.problem->Evaluate(options, &cost, nullptr, &g, &crs));
    const Eigen::MatrixXd J = DenseOf(crs);
    *gradient = Eigen::Map<Eigen::VectorXd>(g.data(), g.size());
    *H = J.transpose() * J;
    return cost;
  }

  void ExpectBlocksAgreeWithCeres() {
    Eigen::VectorXd expected_gradient;
    Eigen::MatrixXd expected_H;
    const double expected_cost = AssembleWithCeres(&expected_gradient, &expected_H);
    NormalEquations equations(strip_.builder, config_);
    const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
    ASSERT_TRUE(equations.SetStructure(&structure));
    for (const int threads : {1, 2}) {
      double cost = 0.0;
      std::vector<double> values;
      Eigen::VectorXd gradient;
      ASSERT_TRUE(equations.Evaluate(moved_, threads, &cost, &values, &gradient));
      EXPECT_NEAR(cost, expected_cost, 1e-12 * expected_cost);
      EXPECT_LT((gradient - expected_gradient).norm(), 1e-12 * expected_gradient.norm());
      const Eigen::MatrixXd H = DenseOf(structure, values);
      EXPECT_LT((H - expected_H).norm(), 1e-12 * expected_H.norm());
      // Without the matrix the cost has the same bits. Without the gradient no jets are used, which
      // round differently.
      double other_cost = 0.0;
      Eigen::VectorXd other_gradient;
      ASSERT_TRUE(equations.EvaluateGradient(moved_, threads, &other_cost, &other_gradient));
      EXPECT_EQ(other_cost, cost);
      EXPECT_EQ(other_gradient, gradient);
      ASSERT_TRUE(equations.EvaluateCost(moved_, threads, &other_cost));
      EXPECT_NEAR(other_cost, cost, 1e-14 * cost);
    }
  }

  StripBuilder strip_{Options()};
  DeformationState state_ = RandomState(strip_.problem, 0.1, 4);
  DeformationState moved_;
  Marginalization marginalization_;
  ProblemConfig config_;
};

TEST_F(ExtraResidualTest, StandsInForWhatTouchesEliminatedNodes) {
  // Rotation: one residual per node. Regularisation: both directions along three rows and four
  // columns.
  constexpr int kKept = 12 + 2 * (3 * 3 + 4 * 2);
  const std::vector<SelectedResidual> selected = strip_.builder.Select(config_);
  ASSERT_EQ(static_cast<int>(selected.size()),
            kKept + strip_.builder.NumResidualBlocks(strip_.data) + 1);
  EXPECT_EQ(selected.back().cost, &marginalization_.prior());
  EXPECT_EQ(selected.back().term, -1);
  EXPECT_EQ(selected.back().weight, 1.0);
  for (const SelectedResidual& residual : selected) {
    for (int i = 0; i < residual.num_blocks; ++i) EXPECT_LT(residual.blocks[i].node, 12);
  }
}

TEST_F(ExtraResidualTest, BlocksAgreeWithCeres) { ExpectBlocksAgreeWithCeres(); }

TEST_F(ExtraResidualTest, BlocksAgreeWithCeresWhereSomeOfItsNodesAreHeld) {
  config_.variable_nodes[10] = 0;
  ExpectBlocksAgreeWithCeres();
}

TEST_F(ExtraResidualTest, IsLeftOutWhereItTouchesNothingVariable) {
  for (int j = 9; j < 12; ++j) config_.variable_nodes[j] = 0;
  for (const SelectedResidual& residual : strip_.builder.Select(config_)) {
    EXPECT_NE(residual.cost, &marginalization_.prior());
  }
}

TEST_F(ExtraResidualTest, EliminatedNodesMustNotBeVariable) {
  config_.variable_nodes[17] = 1;
  EXPECT_DEATH(static_cast<void>(strip_.builder.Select(config_)),
               "node 17 is both variable and eliminated");
}

}  // namespace
}  // namespace ceres_ed
