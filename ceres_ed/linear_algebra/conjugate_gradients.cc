#include "ceres_ed/linear_algebra/conjugate_gradients.h"

#include <glog/logging.h>

namespace ceres_ed {
namespace {

using Sums = Eigen::Array<double, 1, 3>;

Sums Dots(const ThreeColumns& a, const ThreeColumns& b) {
  return a.cwiseProduct(b).colwise().sum().array();
}

// Returns a / b, and 0 for a column that is solved.
Sums Ratio(const Sums& a, const Sums& b) { return (b > 0.0).select(a / b, 0.0); }

}  // namespace

bool SolveByConjugateGradients(const Eigen::SparseMatrix<double, Eigen::RowMajor, int>& A,
                               const ThreeColumns& B,
                               const ConjugateGradientOptions& options,
                               ThreeColumns* X) {
  CHECK_EQ(A.rows(), B.rows());
  const Eigen::VectorXd inverse = A.diagonal().cwiseInverse();
  X->setZero(B.rows(), 3);
  ThreeColumns residual = B;
  ThreeColumns preconditioned = inverse.asDiagonal() * residual;
  ThreeColumns direction = preconditioned;
  ThreeColumns product(B.rows(), 3);
  Sums energy = Dots(residual, preconditioned);
  const Sums goal = options.tolerance * options.tolerance * Dots(B, B);
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    if ((Dots(residual, residual) <= goal).all()) return true;
    if (options.should_stop && options.should_stop()) return false;
    product.noalias() = A * direction;
    const Sums step = Ratio(energy, Dots(direction, product));
    *X += direction * step.matrix().asDiagonal();
    residual -= product * step.matrix().asDiagonal();
    preconditioned = inverse.asDiagonal() * residual;
    const Sums next = Dots(residual, preconditioned);
    direction = preconditioned + direction * Ratio(next, energy).matrix().asDiagonal();
    energy = next;
  }
  return true;
}

}  // namespace ceres_ed
