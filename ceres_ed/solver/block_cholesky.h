// Sparse Cholesky of a block matrix, with the symbolic part kept.
#ifndef CERES_ED_SOLVER_BLOCK_CHOLESKY_H_
#define CERES_ED_SOLVER_BLOCK_CHOLESKY_H_

#include <ceres_ed/solver/block_structure.h>

#include <memory>

#include <Eigen/Core>

namespace ceres_ed {

// Factorises H + diag(d) = L L^T. Ordered on the block graph, which is an order of magnitude
// smaller than the scalar one; CHOLMOD's supernodal factor where the library was built with it,
// else Eigen's. One object serves one thread at a time.
class BlockCholesky {
 public:
  // Analyses `structure`, which must outlive this.
  explicit BlockCholesky(const BlockStructure& structure);
  ~BlockCholesky();
  BlockCholesky(const BlockCholesky&) = delete;
  BlockCholesky& operator=(const BlockCholesky&) = delete;

  // `values` in the layout of the structure (of diagonal blocks the lower triangle counts),
  // `diagonal` of num_rows() is added. False when the sum isn't positive definite.
  bool Factorize(const double* values, const Eigen::VectorXd& diagonal);

  // The solution for `rhs` of num_rows(), with the last successful factor.
  Eigen::VectorXd Solve(const Eigen::VectorXd& rhs);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_BLOCK_CHOLESKY_H_
