// Sparse Cholesky factorisation of a block matrix; its symbolic part is computed once and kept.
#ifndef CERES_ED_LINEAR_ALGEBRA_BLOCK_CHOLESKY_H_
#define CERES_ED_LINEAR_ALGEBRA_BLOCK_CHOLESKY_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/double_buffer.h>
#include <ceres_ed/linear_algebra/selected_inverse.h>

#include <cstddef>
#include <functional>
#include <memory>

#include <Eigen/Core>

namespace ceres_ed {

// The multifrontal Cholesky factorisation H + diag(d) = L L^T of a sparse block matrix H.
//
// The order of elimination is computed on the graph of the blocks, which is smaller than the graph
// of the scalar rows by an order of magnitude. If the head of a block shares no value with the
// heads of other blocks, the head is eliminated before everything else, so that three of the twelve
// rows of the block are left. With dual blocks the factorisation is L S L^T, where S is -1 for dual
// rows and 1 for the others.
//
// One object serves one thread at a time.
class BlockCholesky {
 public:
  // Analyses `structure`, which must outlive this object. Its last `num_trailing` blocks also come
  // last in the order of elimination, so that the factor ends with their rows and columns. `memory`
  // must outlive this object and must not serve another factor at the same time; if it is null, the
  // object uses memory of its own. If `should_stop` returns true, a faster analysis is made that
  // gives more fill.
  explicit BlockCholesky(const BlockStructure& structure,
                         int num_trailing = 0,
                         FactorMemory* memory = nullptr,
                         const std::function<bool()>& should_stop = {});
  ~BlockCholesky();
  BlockCholesky(const BlockCholesky&) = delete;
  BlockCholesky& operator=(const BlockCholesky&) = delete;

  // Factorises the matrix with these `values` and `diagonal` added. `values` has the layout of the
  // structure (only the lower triangle of a diagonal block is read), and `diagonal` has num_rows()
  // entries. Returns false if the sum is not positive definite (with dual blocks: not
  // quasi-definite). The result has the same bits at any number of threads.
  // Also returns false if `should_stop`, which is called by one thread at a time, returns true.
  bool Factorize(const double* values,
                 const Eigen::VectorXd& diagonal,
                 int num_threads = 1,
                 const std::function<bool()>& should_stop = {});

  // Returns the solution for a right side `rhs` of num_rows() entries, with the last successful
  // factor.
  Eigen::VectorXd Solve(const Eigen::VectorXd& rhs);

  // Return L^-1 rhs and L^-T rhs with the last successful factor, for a structure without dual
  // blocks. L is the factor of a permuted matrix, but the rows of the argument and of the result
  // have the order of the structure.
  Eigen::VectorXd SolveLower(const Eigen::VectorXd& rhs);
  Eigen::VectorXd SolveUpper(const Eigen::VectorXd& rhs);

  // Returns the rows and columns of L that belong to the trailing blocks, which are the Cholesky
  // factor of their Schur complement (Eq. 20). The matrix is lower triangular, with zeros above the
  // diagonal.
  Eigen::MatrixXd TrailingFactor() const;

  // Returns the logarithm of the determinant of the matrix of the last successful factor, for a
  // structure without dual blocks.
  double LogDeterminant() const;

  // Returns the entries of the inverse at all places where the factor may be non-zero, with the
  // last successful factor of a structure without dual blocks. This object must outlive the result.
  SelectedInverse Invert() const;

  // Returns the number of multiplications that one factorisation takes.
  double NumOperations() const;

  // Returns the number of values that the factor stores.
  std::size_t NumValues() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_BLOCK_CHOLESKY_H_
