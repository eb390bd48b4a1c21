// The inverse of a matrix that need not have one.
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

// How something depends on a block: rows x size(block).
struct BlockDerivative {
  int block = -1;
  Eigen::MatrixXd jacobian;
};

// H^-1 of a positive semi-definite H, and which blocks have one.
//
// With D the diagonal of H, floored where nothing curves a parameter, Z(e) = (H + e D)^-1 is there
// whatever the rank of H. A direction of curvature c (relative to D) has the variance 1 / (c + e)
// in it. Z at e and at 10 e tells the two kinds apart, block by block and at any number of them:
//   c >> e: both are the same; Z(e) + (Z(e) - Z(10 e)) / 9 is H^-1 but for terms of (e / c)^2.
//   c << e: the variance is the regulariser's, and Z(10 e) is a tenth of it.
// A block is undetermined where a direction of it loses more than a tenth of its variance from e to
// 10 e, that is, where c < 80 e. e = 1e-10: far below the curvatures of a problem that one would
// want to solve, far above rounding.
class RegularizedInverse {
 public:
  // `values` of H in the layout of `structure`, which has no dual blocks. Null where H isn't
  // positive semi-definite or isn't finite.
  static std::unique_ptr<RegularizedInverse> Create(BlockStructure structure,
                                                    const std::vector<double>& values,
                                                    int num_threads);

  const BlockStructure& structure() const { return structure_; }

  bool is_determined(int block) const { return is_determined_[block] != 0; }

  // sum_ab J_a Z_ab J_b^T over the blocks that are named, each once. Blocks that share no entry of
  // the factor cost a few solves. A term of an undetermined block is as large as the regulariser
  // leaves it, unless its Jacobian vanishes in that direction. From several threads at once, too.
  Eigen::MatrixXd Propagate(const std::vector<BlockDerivative>& parts) const;

  // The same; false, at once, where parts of Z are missing, which count as zero.
  bool PropagateSelected(const std::vector<BlockDerivative>& parts, Eigen::MatrixXd* result) const;

 private:
  explicit RegularizedInverse(BlockStructure structure)
      : structure_(std::move(structure)), weak_(structure_), strong_(structure_) {}

  bool Invert(const std::vector<double>& values, int num_threads);
  Eigen::MatrixXd Solve(const std::vector<BlockDerivative>& parts) const;

  const BlockStructure structure_;
  // Of H + e D and H + 10 e D.
  mutable BlockCholesky weak_;
  mutable BlockCholesky strong_;
  // Guards them.
  mutable std::mutex mutex_;
  std::optional<SelectedInverse> inverse_;
  std::vector<char> is_determined_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_REGULARIZED_INVERSE_H_
