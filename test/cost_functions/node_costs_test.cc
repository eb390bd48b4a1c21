#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/testing/cost_laws.h>

#include <cmath>
#include <memory>

#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>
#include <cost_functions/node_prior_cost.h>
#include <cost_functions/regularization_cost.h>
#include <cost_functions/rotation_cost.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::IsEmpty;

Eigen::Matrix3d ExampleRotation() {
  return Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
}

std::vector<double> MakeNode(const Eigen::Matrix3d& A, const Eigen::Vector3d& t) {
  std::vector<double> node(kNodeSize);
  MutableNodeAffine(node.data()) = A;
  MutableNodeTranslation(node.data()) = t;
  return node;
}

// Moves the node at g by x -> B x + b: A_j -> B A_j, and g + t -> B (g + t) + b.
void MoveNode(const Eigen::Matrix3d& B,
              const Eigen::Vector3d& b,
              const Eigen::Vector3d& g,
              double* node) {
  MutableNodeAffine(node) = (B * NodeAffine(node)).eval();
  MutableNodeTranslation(node) = (B * (g + NodeTranslation(node)) + b - g).eval();
}

TEST(NodeParameters, AreTheColumnsOfAThenT) {
  double node[kNodeSize];
  for (int i = 0; i < kNodeSize; ++i) node[i] = i + 1.0;
  const double* view = node;
  EXPECT_EQ(NodeAffine(view).col(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(NodeAffine(view).col(2), Eigen::Vector3d(7, 8, 9));
  EXPECT_EQ(NodeTranslation(view), Eigen::Vector3d(10, 11, 12));
  SetNodeToRest(node);
  EXPECT_EQ(NodeAffine(view), Eigen::Matrix3d::Identity());
  EXPECT_EQ(NodeTranslation(view), Eigen::Vector3d::Zero());
}

TEST(RotationCost, ObeysTheLaws) {
  const std::unique_ptr<ceres::CostFunction> cost(RotationCost::Create());
  CostClaims claims;
  claims.rest = {RestNode()};
  claims.invariances.push_back(
      {"a rotation of A", [](ParameterBlocks* blocks) {
         MoveNode(ExampleRotation(), {1.0, 2.0, 3.0}, Eigen::Vector3d::Zero(), (*blocks)[0].data());
       }});
  claims.invariances.push_back(
      {"a reflection of A", [](ParameterBlocks* blocks) {
         const Eigen::Matrix3d mirror = Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal();
         MoveNode(mirror, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), (*blocks)[0].data());
       }});
  EXPECT_THAT(CheckCostLaws(*cost, claims), IsEmpty());
}

TEST(RotationCost, HasTheResidualsOfEquation5InOrder) {
  const std::unique_ptr<ceres::CostFunction> cost(RotationCost::Create());
  Eigen::Matrix3d A;
  A.col(0) = Eigen::Vector3d(1, 2, 3);
  A.col(1) = Eigen::Vector3d(-1, 0, 2);
  A.col(2) = Eigen::Vector3d(4, 1, -2);
  const CostEvaluation evaluation =
      EvaluateResiduals(*cost, {MakeNode(A, Eigen::Vector3d(7, 8, 9))});
  Eigen::VectorXd expected(6);
  // c1.c2 = -1 + 6, c1.c3 = 4 + 2 - 6, c2.c3 = -4 - 4, then the squared lengths 14, 5, 21 minus
  // one.
  expected << 5, 0, -8, 13, 4, 20;
  EXPECT_EQ(evaluation.residuals, expected);
}

TEST(RotationCost, VanishesForEveryRotation) {
  const std::unique_ptr<ceres::CostFunction> cost(RotationCost::Create());
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d(i - 7.0, 3.0, 1.0 + i).normalized())
            .toRotationMatrix();
    EXPECT_LT(EvaluateResiduals(*cost, {MakeNode(R, Eigen::Vector3d::Zero())}).residuals.norm(),
              1e-14);
  }
}

TEST(NodePriorCost, ObeysTheLaws) {
  const Eigen::Vector3d prior(0.4, -1.5, 2.0);
  const std::unique_ptr<ceres::CostFunction> cost(NodePriorCost::Create(prior));
  CostClaims claims;
  claims.rest = {MakeNode(Eigen::Matrix3d::Identity(), prior)};
  claims.invariances.push_back({"a change of A", [](ParameterBlocks* blocks) {
                                  MutableNodeAffine((*blocks)[0].data()) *= -3.0;
                                }});
  EXPECT_THAT(CheckCostLaws(*cost, claims), IsEmpty());
}

TEST(NodePriorCost, IsTheWayFromThePriorToTheTranslation) {
  const std::unique_ptr<ceres::CostFunction> cost(NodePriorCost::Create({1.0, 2.0, -3.0}));
  const CostEvaluation evaluation =
      EvaluateResiduals(*cost, {MakeNode(Eigen::Matrix3d::Zero(), {1.5, 0.0, -2.0})});
  EXPECT_EQ(evaluation.residuals, Eigen::Vector3d(0.5, -2.0, 1.0));
}

TEST(RegularizationCost, ObeysTheLaws) {
  const Eigen::Vector3d g_j(0.3, -0.2, 1.0);
  const Eigen::Vector3d g_k(0.9, 0.4, 0.7);
  const std::unique_ptr<ceres::CostFunction> cost(RegularizationCost::Create(g_j, g_k, 0.7));
  CostClaims claims;
  claims.rest = {RestNode(), RestNode()};
  claims.invariances.push_back({"a common translation", [&](ParameterBlocks* blocks) {
                                  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
                                  const Eigen::Vector3d b(1.0, -2.0, 0.5);
                                  MoveNode(I, b, g_j, (*blocks)[0].data());
                                  MoveNode(I, b, g_k, (*blocks)[1].data());
                                }});
  claims.invariances.push_back({"a rigid motion of the result",
                                [&](ParameterBlocks* blocks) {
                                  const Eigen::Vector3d b(1.0, -2.0, 0.5);
                                  MoveNode(ExampleRotation(), b, g_j, (*blocks)[0].data());
                                  MoveNode(ExampleRotation(), b, g_k, (*blocks)[1].data());
                                },
                                true});
  claims.invariances.push_back({"a change of A_k", [](ParameterBlocks* blocks) {
                                  MutableNodeAffine((*blocks)[1].data()) *= -3.0;
                                }});
  EXPECT_THAT(CheckCostLaws(*cost, claims), IsEmpty());
}

TEST(RegularizationCost, ObeysTheLawsOnCoincidentNodesAndWithoutWeight) {
  const Eigen::Vector3d g(0.3, -0.2, 1.0);
  CostClaims claims;
  claims.rest = {RestNode(), RestNode()};
  const std::unique_ptr<ceres::CostFunction> coincident(RegularizationCost::Create(g, g, 1.0));
  EXPECT_THAT(CheckCostLaws(*coincident, claims), IsEmpty());
  const std::unique_ptr<ceres::CostFunction> weightless(
      RegularizationCost::Create(g, Eigen::Vector3d::Zero(), 0.0));
  EXPECT_THAT(CheckCostLaws(*weightless, claims), IsEmpty());
}

TEST(RegularizationCost, IsExactlyZeroAtRest) {
  const std::unique_ptr<ceres::CostFunction> cost(
      RegularizationCost::Create({0.1, 0.2, 0.3}, {100.7, -3.3, 0.9}, 0.3));
  EXPECT_EQ(EvaluateResiduals(*cost, {RestNode(), RestNode()}).residuals, Eigen::Vector3d::Zero());
}

TEST(RegularizationCost, EqualsEquation6) {
  const Eigen::Vector3d g_j(1.0, 2.0, 3.0);
  const Eigen::Vector3d g_k(2.0, 2.0, 1.0);
  const std::unique_ptr<ceres::CostFunction> cost(RegularizationCost::Create(g_j, g_k, 4.0));
  Eigen::Matrix3d A;
  A << 1, 2, 0, 0, 1, 1, 3, 0, 1;
  const CostEvaluation evaluation =
      EvaluateResiduals(*cost,
                        {MakeNode(A, Eigen::Vector3d(0.5, 0.0, -1.0)),
                         MakeNode(9.0 * A, Eigen::Vector3d(0.0, 1.0, 0.0))});
  // A (g_k - g_j) = A (1, 0, -2) = (1, -2, 1). Adding g_j + t_j gives (2.5, 0, 3). The residual is
  // twice the difference from (2, 3, 1).
  EXPECT_LT((evaluation.residuals - Eigen::Vector3d(1.0, -6.0, 4.0)).norm(), 1e-14);
}

TEST(RegularizationCost, VanishesUnderAnAffineMotionThatAllNodesShare) {
  const Eigen::Vector3d g_j(1.0, 2.0, 3.0);
  const Eigen::Vector3d g_k(2.0, 2.0, 1.0);
  const std::unique_ptr<ceres::CostFunction> cost(RegularizationCost::Create(g_j, g_k, 4.0));
  Eigen::Matrix3d B;
  B << 1.2, 0.4, -0.3, 0.1, 0.8, 0.2, -0.5, 0.3, 1.1;
  const Eigen::Vector3d b(3.0, -1.0, 2.0);
  ParameterBlocks blocks{RestNode(), RestNode()};
  MoveNode(B, b, g_j, blocks[0].data());
  MoveNode(B, b, g_k, blocks[1].data());
  EXPECT_LT(EvaluateResiduals(*cost, blocks).residuals.norm(), 1e-14);
}

}  // namespace
}  // namespace ceres_ed
