// The diagonal blocks of a matrix as its preconditioner.
#ifndef CERES_ED_LINEAR_ALGEBRA_ITERATIVE_BLOCK_JACOBI_H_
#define CERES_ED_LINEAR_ALGEBRA_ITERATIVE_BLOCK_JACOBI_H_

#include <ceres_ed/linear_algebra/iterative/preconditioner.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// M consists of the blocks of the nodes, D, and of the camera's block E with the border C that
// couples it to the nodes, [D C^T; C E]. The camera is the last primal block if that is smaller
// than the block of a node. M is inverted by the Schur complement E - C D^-1 C^T; where that is not
// positive definite, the border is left out.
class BlockJacobi final : public Preconditioner {
 public:
  // `matrix` must outlive this object.
  explicit BlockJacobi(const PrimalMatrix& matrix);

  bool Update(int num_threads) override;
  void Apply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) override;

 private:
  void UpdateBorder();

  const PrimalMatrix& matrix_;
  // The blocks that stand alone, and the camera's, or -1.
  int num_blocks_ = 0;
  int border_ = -1;
  // D^-1, block after block, in full.
  std::vector<double> inverses_;
  std::vector<std::size_t> places_;
  // The inverse of the Schur complement, and whether it contains the border.
  Eigen::MatrixXd border_inverse_;
  bool has_border_ = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ITERATIVE_BLOCK_JACOBI_H_
