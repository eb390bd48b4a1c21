#include "cost_functions/quadratic_cost.h"

#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/testing/cost_laws.h>

#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::IsEmpty;

const std::vector<int> kSizes = {3, 5, 2};

Eigen::MatrixXd RandomMatrix(int rows, int columns, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

// Returns |J d + r|^2 / 2 + offset with a J of `rank` rows over ten parameters.
Quadratic LeastSquares(int rank, double offset) {
  const Eigen::MatrixXd J = RandomMatrix(rank, 10, 1);
  const Eigen::VectorXd r = RandomMatrix(rank, 1, 2);
  Quadratic quadratic;
  quadratic.origin = RandomMatrix(10, 1, 3);
  quadratic.hessian = J.transpose() * J;
  quadratic.gradient = J.transpose() * r;
  quadratic.constant = 0.5 * r.squaredNorm() + offset;
  return quadratic;
}

ParameterBlocks Split(const Eigen::VectorXd& x) {
  ParameterBlocks blocks;
  int row = 0;
  for (const int size : kSizes) {
    blocks.push_back(CopyBlock(x.data() + row, size));
    row += size;
  }
  return blocks;
}

TEST(QuadraticCost, ObeysTheLaws) {
  for (const int rank : {10, 7}) {
    const Quadratic quadratic = LeastSquares(rank, 0.3);
    const QuadraticCost cost(kSizes, quadratic);
    CostClaims claims;
    claims.rest = Split(quadratic.origin);
    // The smallest value is at its minimum, not where it was linearised.
    claims.squared_norm_at_rest.reset();
    EXPECT_THAT(CheckCostLaws(cost, claims), IsEmpty()) << "rank " << rank;
  }
}

TEST(QuadraticCost, CostsWhatTheQuadraticIsWorth) {
  for (const int rank : {10, 7, 1, 0}) {
    const Quadratic quadratic = LeastSquares(rank, 0.3);
    const QuadraticCost cost(kSizes, quadratic);
    for (int seed = 10; seed < 15; ++seed) {
      const Eigen::VectorXd d = RandomMatrix(10, 1, seed);
      const CostEvaluation found = EvaluateResiduals(cost, Split(quadratic.origin + d));
      ASSERT_TRUE(found.evaluated);
      EXPECT_NEAR(0.5 * found.residuals.squaredNorm(), quadratic.Value(d), 1e-12) << rank;
    }
  }
}

TEST(QuadraticCost, SquareRootHasHessianGradientAndConstant) {
  for (const int rank : {10, 7}) {
    const Quadratic quadratic = LeastSquares(rank, 0.3);
    const QuadraticCost cost(kSizes, quadratic);
    const SquareRootForm& form = cost.SquareRoot();
    EXPECT_LT((form.root.transpose() * form.root - quadratic.hessian).norm(), 1e-13);
    EXPECT_LT((form.root.transpose() * form.residual - quadratic.gradient).norm(), 1e-12);
    EXPECT_NEAR(form.constant, 0.3, 1e-12);
    // The rows of directions that cost nothing are zero and do not contain rounding errors.
    int zero_rows = 0;
    for (int i = 0; i < cost.size(); ++i) zero_rows += form.root.row(i).isZero(0.0) ? 1 : 0;
    EXPECT_EQ(zero_rows, 10 - rank);
  }
}

TEST(QuadraticCost, TakesAnotherQuadraticAndAnotherOrigin) {
  QuadraticCost cost(kSizes, LeastSquares(7, 0.3));
  const Quadratic& old = cost.quadratic();
  const Eigen::VectorXd shift = RandomMatrix(10, 1, 20);
  // The same function, expanded about another point.
  const Quadratic before = old;
  cost.SquareRoot();
  cost.SetOrigin(
      before.origin + shift, before.gradient + before.hessian * shift, before.Value(shift));
  const Eigen::VectorXd x = RandomMatrix(10, 1, 21);
  const CostEvaluation found = EvaluateResiduals(cost, Split(x));
  EXPECT_NEAR(0.5 * found.residuals.squaredNorm(), before.Value(x - before.origin), 1e-12);
  Quadratic twice = before;
  twice.hessian *= 2.0;
  twice.gradient *= 2.0;
  twice.constant *= 2.0;
  cost.Set(twice);
  const CostEvaluation doubled = EvaluateResiduals(cost, Split(x));
  EXPECT_NEAR(0.5 * doubled.residuals.squaredNorm(), 2.0 * before.Value(x - before.origin), 1e-12);
}

}  // namespace
}  // namespace ceres_ed
