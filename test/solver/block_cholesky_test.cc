#include "ceres_ed/solver/block_cholesky.h"

#include <random>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <test/solver/dense_matrix.h>

namespace ceres_ed {
namespace {

TEST(BlockCholesky, SolvesWhatDenseCholeskySolves) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::vector<int> sizes = {12, 6, 12, 12, 6, 12, 12};
  const std::vector<BlockPair> pairs = {
      {6, 0}, {1, 2}, {3, 1}, {5, 4}, {4, 5}, {6, 3}, {2, 0}, {0, 5}};
  const BlockStructure structure(sizes, pairs);
  std::vector<double> values(structure.num_values());
  for (double& value : values) value = uniform(random);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 30.0);
  Eigen::MatrixXd dense = DenseOf(structure, values);
  dense.diagonal() += diagonal;
  Eigen::VectorXd rhs(structure.num_rows());
  for (double& value : rhs) value = uniform(random);

  BlockCholesky cholesky(structure);
  ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
  const Eigen::VectorXd expected = dense.llt().solve(rhs);
  EXPECT_LT((cholesky.Solve(rhs) - expected).norm(), 1e-12 * expected.norm());
  // A factor that fails leaves an object that still works.
  EXPECT_FALSE(cholesky.Factorize(values.data(), -diagonal));
  ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
  EXPECT_LT((cholesky.Solve(rhs) - expected).norm(), 1e-12 * expected.norm());
}

// The factor of a matrix that is permuted all but for its end.
TEST(BlockCholesky, EndsInTheFactorOfTheSchurComplementOfTheTrailingBlocks) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::vector<BlockPair> pairs = {
      {6, 0}, {1, 2}, {3, 1}, {5, 4}, {6, 3}, {2, 0}, {0, 5}, {4, 3}};
  const BlockStructure structure({12, 6, 12, 12, 6, 12, 12}, pairs);
  std::vector<double> values(structure.num_values());
  for (double& value : values) value = uniform(random);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 30.0);
  Eigen::MatrixXd A = DenseOf(structure, values);
  A.diagonal() += diagonal;
  for (const int trailing : {0, 1, 3, 7}) {
    const Eigen::Index n = structure.row_offset(7 - trailing);
    const Eigen::Index rest = A.rows() - n;
    Eigen::MatrixXd schur = A.bottomRightCorner(rest, rest);
    if (n > 0) {
      schur -= A.bottomLeftCorner(rest, n) *
               A.topLeftCorner(n, n).llt().solve(A.topRightCorner(n, rest));
    }
    BlockCholesky cholesky(structure, trailing);
    ASSERT_TRUE(cholesky.Factorize(values.data(), diagonal));
    const Eigen::MatrixXd L = cholesky.TrailingFactor();
    EXPECT_LT((L - Eigen::MatrixXd(schur.llt().matrixL())).norm(), 1e-12 * A.norm()) << trailing;
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0);
    const Eigen::VectorXd expected = A.llt().solve(b);
    EXPECT_LT((cholesky.Solve(b) - expected).norm(), 1e-12 * expected.norm());
    EXPECT_LT((cholesky.SolveUpper(cholesky.SolveLower(b)) - expected).norm(),
              1e-12 * expected.norm());
  }
}

TEST(BlockStructure, FindsWhatItHasAndNothingElse) {
  const BlockStructure structure({12, 6, 12}, {{0, 2}, {2, 0}});
  EXPECT_EQ(structure.num_entries(), 4);
  EXPECT_EQ(structure.entry_row(structure.FindEntry(2, 0)), 2);
  EXPECT_EQ(structure.FindEntry(1, 0), -1);
  EXPECT_EQ(structure.FindEntry(2, 1), -1);
  EXPECT_EQ(structure.num_values(), 12u * 12 + 12 * 12 + 6 * 6 + 12 * 12);
}

}  // namespace
}  // namespace ceres_ed
