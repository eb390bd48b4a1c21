// Sparse Cholesky of a scalar matrix, for several right sides at once.
#ifndef CERES_ED_LINEAR_ALGEBRA_SPARSE_CHOLESKY_H_
#define CERES_ED_LINEAR_ALGEBRA_SPARSE_CHOLESKY_H_

#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ceres_ed {

// Factorises a symmetric matrix A = L L^T as BlockCholesky does. One object serves one thread at a
// time.
class SparseCholesky {
 public:
  // The lower triangle of A, column by column: compressed, each column by row from its diagonal on.
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  // Analyses the pattern of `lower`; the values don't matter yet.
  explicit SparseCholesky(const Matrix& lower);
  ~SparseCholesky();
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  // False when A isn't positive definite. `lower` has the pattern that was analysed.
  bool Factorize(const Matrix& lower);

  // The solution for every column of `rhs`, with the last successful factor.
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& rhs);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_SPARSE_CHOLESKY_H_
