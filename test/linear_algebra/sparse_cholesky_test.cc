#include <ceres_ed/linear_algebra/sparse_cholesky.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Returns a tridiagonal matrix with one long row, which is positive definite.
Eigen::MatrixXd MakeMatrix(int size) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < size; ++i) {
    A(i, i) = 4.0 + 0.1 * i;
    if (i > 0) A(i, i - 1) = A(i - 1, i) = -1.0;
    if (i > 1) A(i, 0) = A(0, i) = 0.01;
  }
  return A;
}

SparseCholesky::Matrix Lower(const Eigen::MatrixXd& A) {
  return Eigen::MatrixXd(A.triangularView<Eigen::Lower>()).sparseView();
}

TEST(SparseCholesky, SolvesForEveryColumnAsTheDenseFactorDoes) {
  const Eigen::MatrixXd A = MakeMatrix(40);
  Eigen::MatrixXd rhs(40, 3);
  for (int i = 0; i < 40; ++i) rhs.row(i) << 1.0, 0.5 * i, 1.0 / (1 + i);
  SparseCholesky cholesky(Lower(A));
  ASSERT_TRUE(cholesky.Factorize(Lower(A)));
  EXPECT_LT((cholesky.Solve(rhs) - A.llt().solve(rhs)).norm(), 1e-12);
  // Other values, and another number of columns.
  ASSERT_TRUE(cholesky.Factorize(Lower(2.0 * A)));
  EXPECT_LT((cholesky.Solve(rhs.leftCols(1)) - 0.5 * A.llt().solve(rhs.leftCols(1))).norm(), 1e-12);
}

TEST(SparseCholesky, SaysThatAMatrixIsNotPositiveDefinite) {
  Eigen::MatrixXd A = MakeMatrix(40);
  SparseCholesky cholesky(Lower(A));
  A(20, 20) = -1.0;
  EXPECT_FALSE(cholesky.Factorize(Lower(A)));
  A(20, 20) = 6.0;
  EXPECT_TRUE(cholesky.Factorize(Lower(A)));
}

}  // namespace
}  // namespace ceres_ed
