// Solves a sparse symmetric system without a factor.
#ifndef CERES_ED_LINEAR_ALGEBRA_CONJUGATE_GRADIENTS_H_
#define CERES_ED_LINEAR_ALGEBRA_CONJUGATE_GRADIENTS_H_

#include <functional>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ceres_ed {

// When conjugate gradients end.
struct ConjugateGradientOptions {
  // They end when each column of the residual is at most this part of the right side, > 0.
  double tolerance = 1e-4;
  // And after this number of products with the matrix, >= 1.
  int max_iterations = 300;
  // Called in every iteration; if it returns true, there is no solution.
  std::function<bool()> should_stop;
};

// Three right sides or solutions, one in each column.
using ThreeColumns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// Solves A X = B for a symmetric positive definite A, by conjugate gradients with the diagonal as
// preconditioner (Hestenes and Stiefel 1952), from X = 0. Both triangles of A are stored. Memory
// and the time of an iteration are in proportion to the entries, and the iterations grow with the
// root of the condition number. Stopping early gives the best X of the directions so far, so that
// it is a descent step of X^T A X / 2 - X^T B in any case. Returns false if it was stopped by
// `should_stop`. Uses one thread.
bool SolveByConjugateGradients(const Eigen::SparseMatrix<double, Eigen::RowMajor, int>& A,
                               const ThreeColumns& B,
                               const ConjugateGradientOptions& options,
                               ThreeColumns* X);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_CONJUGATE_GRADIENTS_H_
