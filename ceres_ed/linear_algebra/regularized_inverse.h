// The inverse of a positive semi-definite matrix, which may be singular.
#ifndef CERES_ED_LINEAR_ALGEBRA_REGULARIZED_INVERSE_H_
#define CERES_ED_LINEAR_ALGEBRA_REGULARIZED_INVERSE_H_

#include <ceres_ed/linear_algebra/block_cholesky.h>
#include <ceres_ed/linear_algebra/block_structure.h>

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The derivative of a quantity with respect to a block, of rows x size(block).
struct BlockDerivative {
  int block = -1;
  Eigen::MatrixXd jacobian;
};

// H^-1 of a positive semi-definite H, and which of its blocks have an inverse.
//
// Let D be the diagonal of H, with a lower bound for parameters without curvature. Then the matrix
// Z(e) = (H + e D)^-1 exists whatever the rank of H. A direction with curvature c (relative to D)
// has the variance 1 / (c + e) in Z(e). A comparison of Z(e) with Z(10 e) distinguishes two cases,
// for each block:
//   c >> e: both are equal, and Z(e) + (Z(e) - Z(10 e)) / 9 is H^-1 up to terms of order (e / c)^2.
//   c << e: the regulariser determines the variance, and Z(10 e) is a tenth of Z(e).
// A block is undetermined if one of its directions loses more than a tenth of its variance from e
// to 10 e, which is the case if c < 80 e. The value e = 1e-10 is far below the curvatures of any
// problem that can sensibly be solved, and far above rounding errors.
class RegularizedInverse {
 public:
  // Returns the inverse of the H with these `values` in the layout of `structure`, which has no
  // dual blocks. Returns null if H is not positive semi-definite or not finite.
  static std::unique_ptr<RegularizedInverse> Create(BlockStructure structure,
                                                    const std::vector<double>& values,
                                                    int num_threads);

  const BlockStructure& structure() const { return structure_; }

  // Returns whether the inverse of H exists on this block.
  bool is_determined(int block) const { return is_determined_[block] != 0; }

  // Returns the covariance sum_ab J_a Z_ab J_b^T over the blocks in `parts`, each of which is named
  // once. Pairs of blocks that share no entry of the factor cost a few solves. The contribution of
  // an undetermined block is as large as the regulariser permits, unless its Jacobian is zero in
  // that direction. May be called from several threads at once.
  Eigen::MatrixXd Propagate(const std::vector<BlockDerivative>& parts) const;

  // Returns H^-1 `rhs`, with the same treatment of undetermined blocks.
  Eigen::VectorXd Solve(const Eigen::VectorXd& rhs) const;

  // Computes Propagate() without solves. If parts of Z are missing, they count as zero, and it
  // returns false.
  bool PropagateSelected(const std::vector<BlockDerivative>& parts, Eigen::MatrixXd* result) const;

 private:
  explicit RegularizedInverse(BlockStructure structure)
      : structure_(std::move(structure)), weak_(structure_), strong_(structure_) {}

  bool Invert(const std::vector<double>& values, int num_threads);
  Eigen::MatrixXd Solve(const std::vector<BlockDerivative>& parts) const;
  // Needs mutex_.
  Eigen::VectorXd SolveLocked(const Eigen::VectorXd& rhs) const;

  const BlockStructure structure_;
  // The factors of H + e D and of H + 10 e D.
  mutable BlockCholesky weak_;
  mutable BlockCholesky strong_;
  // Guards the two factors.
  mutable std::mutex mutex_;
  std::optional<SelectedInverse> inverse_;
  std::vector<char> is_determined_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_REGULARIZED_INVERSE_H_
