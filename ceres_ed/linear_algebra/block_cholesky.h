// Sparse Cholesky of a block matrix, with the symbolic part kept.
#ifndef CERES_ED_LINEAR_ALGEBRA_BLOCK_CHOLESKY_H_
#define CERES_ED_LINEAR_ALGEBRA_BLOCK_CHOLESKY_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/double_buffer.h>
#include <ceres_ed/linear_algebra/selected_inverse.h>

#include <cstddef>
#include <memory>

#include <Eigen/Core>

namespace ceres_ed {

// Factorises H + diag(d) = L L^T, multifrontal. Ordered on the graph of the blocks, which is an
// order of magnitude smaller than the scalar one. A block whose head shares nothing with
// other heads has its head eliminated ahead of all, so that three rows of it are left where twelve
// would be. With dual blocks the factor is L S L^T with S = -1 for their rows, 1 elsewhere.
// One object serves one thread at a time.
class BlockCholesky {
 public:
  // Analyses `structure`, which must outlive this. Its last `num_trailing` blocks come last in the
  // order of elimination, too, so that the factor ends in theirs.
  // `memory` outlives this and serves no other factor meanwhile; null: memory of its own.
  explicit BlockCholesky(const BlockStructure& structure,
                         int num_trailing = 0,
                         FactorMemory* memory = nullptr);
  ~BlockCholesky();
  BlockCholesky(const BlockCholesky&) = delete;
  BlockCholesky& operator=(const BlockCholesky&) = delete;

  // `values` in the layout of the structure (of diagonal blocks the lower triangle counts),
  // `diagonal` of num_rows() is added. False when the sum isn't positive definite. The same bits at
  // any number of threads.
  bool Factorize(const double* values, const Eigen::VectorXd& diagonal, int num_threads = 1);

  // The solution for `rhs` of num_rows(), with the last successful factor.
  Eigen::VectorXd Solve(const Eigen::VectorXd& rhs);

  // L^-1 rhs and L^-T rhs (of a structure without dual blocks) with the last successful factor,
  // which is that of a permuted matrix: rows stand in the order of the structure all the same.
  Eigen::VectorXd SolveLower(const Eigen::VectorXd& rhs);
  Eigen::VectorXd SolveUpper(const Eigen::VectorXd& rhs);

  // The rows and columns of L that belong to the trailing blocks: the Cholesky factor of their
  // Schur complement (Eq. 20). Lower triangle, zeros above it.
  Eigen::MatrixXd TrailingFactor() const;

  // The inverse where the factor may be non-zero, with the last successful factor of a structure
  // without dual blocks. This must outlive it.
  SelectedInverse Invert() const;

  // Multiplications that one factorisation takes.
  double NumOperations() const;

  // Numbers that the factor keeps.
  std::size_t NumValues() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_BLOCK_CHOLESKY_H_
