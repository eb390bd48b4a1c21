// Sparse Cholesky factorisation of a scalar matrix, for several right sides at once.
#ifndef CERES_ED_LINEAR_ALGEBRA_SPARSE_CHOLESKY_H_
#define CERES_ED_LINEAR_ALGEBRA_SPARSE_CHOLESKY_H_

#include <functional>
#include <memory>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ceres_ed {

// The Cholesky factorisation A = L L^T of a symmetric positive definite matrix, computed by
// BlockCholesky. One object serves one thread at a time.
class SparseCholesky {
 public:
  // The lower triangle of A, compressed and column by column. Each column is sorted by row and
  // starts at its diagonal.
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  // Analyses the pattern of `lower`; its values are not used. If `should_stop` returns true, a
  // faster analysis is made that gives more fill.
  explicit SparseCholesky(const Matrix& lower, const std::function<bool()>& should_stop = {});
  ~SparseCholesky();
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  // Factorises `lower`, which must have the pattern that was analysed. Returns false if A is not
  // positive definite, or if `should_stop` returns true.
  bool Factorize(const Matrix& lower, const std::function<bool()>& should_stop = {});

  // Returns the solution for every column of `rhs`, with the last successful factor.
  Eigen::MatrixXd Solve(const Eigen::MatrixXd& rhs);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_SPARSE_CHOLESKY_H_
