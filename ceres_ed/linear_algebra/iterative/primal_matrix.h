// Products with the matrix of the normal equations, which need no factor.
#ifndef CERES_ED_LINEAR_ALGEBRA_ITERATIVE_PRIMAL_MATRIX_H_
#define CERES_ED_LINEAR_ALGEBRA_ITERATIVE_PRIMAL_MATRIX_H_

#include <ceres_ed/linear_algebra/block_structure.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The matrix A = H + J^T J + diag(d) on the primal rows of a BlockStructure, where H are the blocks
// of two primal blocks, and J those of a dual and a primal block. The diagonal of a dual block is
// taken as -I, so that A is what the elimination of the dual rows leaves. J^T J is never formed.
class PrimalMatrix {
 public:
  // A block of the matrix as its row sees it.
  struct Neighbor {
    // The other block, and the entry of the structure that has the values.
    int block = 0;
    int entry = 0;
    // Whether the row is the column of that entry, so that the values are transposed.
    bool transposed = false;
  };

  // `structure` must outlive this object.
  explicit PrimalMatrix(const BlockStructure& structure);

  const BlockStructure& structure() const { return structure_; }
  int num_blocks() const { return structure_.num_blocks() - structure_.num_dual(); }
  int num_rows() const { return structure_.num_primal_rows(); }

  // Sets the numbers of the matrix, which must outlive their use: `values` in the layout of the
  // structure, with diagonal blocks in full, and `diagonal`, of which the first num_rows() entries
  // are added to the diagonal.
  void SetValues(const double* values, const Eigen::VectorXd& diagonal);

  const double* values(int entry) const { return values_ + structure_.value_offset(entry); }
  double diagonal(int row) const { return diagonal_[row]; }

  // Returns the blocks that share an entry with `block`, itself included, in the order of their
  // indices; primal blocks come first, dual ones last.
  const Neighbor* begin(int block) const { return neighbors_.data() + begins_[block]; }
  const Neighbor* end(int block) const { return neighbors_.data() + begins_[block + 1]; }

  // Computes y = A x. The result has the same bits at any number of threads.
  void Multiply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) const;

  // Returns the diagonal block of A that belongs to a primal block.
  Eigen::MatrixXd DiagonalBlock(int block) const;

 private:
  const BlockStructure& structure_;
  // The neighbours of block b are those from begins_[b] to begins_[b + 1].
  std::vector<std::size_t> begins_;
  std::vector<Neighbor> neighbors_;
  const double* values_ = nullptr;
  const double* diagonal_ = nullptr;
  // J x.
  mutable Eigen::VectorXd dual_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ITERATIVE_PRIMAL_MATRIX_H_
