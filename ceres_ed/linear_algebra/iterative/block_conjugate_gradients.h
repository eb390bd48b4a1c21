// Preconditioned conjugate gradients for the normal equations.
#ifndef CERES_ED_LINEAR_ALGEBRA_ITERATIVE_BLOCK_CONJUGATE_GRADIENTS_H_
#define CERES_ED_LINEAR_ALGEBRA_ITERATIVE_BLOCK_CONJUGATE_GRADIENTS_H_

#include <ceres_ed/linear_algebra/iterative/preconditioner.h>
#include <ceres_ed/linear_algebra/iterative/primal_matrix.h>

#include <functional>

#include <Eigen/Core>

namespace ceres_ed {

// When the iterations end.
struct BlockGradientOptions {
  // They end when the residual r in the norm of the preconditioner, sqrt(r^T M^-1 r), is at most
  // this part of that of the right side, > 0.
  double tolerance = 1e-2;
  // And after this number of products with the matrix, >= 1.
  int max_iterations = 1000;
  int num_threads = 1;
  // Called every 32 iterations; if it returns true, the solution so far is the result.
  std::function<bool()> should_stop;
};

struct BlockGradientSummary {
  int iterations = 0;
  // sqrt(r^T M^-1 r) at the end, relative to the right side.
  double relative_residual = 0.0;
  // Whether the matrix showed a direction without curvature, or a number was not finite. There is
  // no solution then.
  bool failed = false;
};

// Solves A x = b from x = 0 by conjugate gradients with the preconditioner M (Hestenes and Stiefel
// 1952; Concus, Golub and O'Leary 1976). Every iterate has x^T A x = b^T x, so that it minimises
// x^T A x / 2 - b^T x along itself, wherever the iterations end. The result has the same bits at
// any number of threads.
BlockGradientSummary SolveByBlockGradients(const PrimalMatrix& A,
                                           const Eigen::VectorXd& b,
                                           const BlockGradientOptions& options,
                                           Preconditioner* M,
                                           Eigen::VectorXd* x);

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ITERATIVE_BLOCK_CONJUGATE_GRADIENTS_H_
