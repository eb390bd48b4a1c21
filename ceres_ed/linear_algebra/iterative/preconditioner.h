// The interface of a preconditioner of the normal equations.
#ifndef CERES_ED_LINEAR_ALGEBRA_ITERATIVE_PRECONDITIONER_H_
#define CERES_ED_LINEAR_ALGEBRA_ITERATIVE_PRECONDITIONER_H_

#include <ceres_ed/linear_algebra/iterative/primal_matrix.h>

#include <Eigen/Core>

namespace ceres_ed {

// An approximation M of a matrix A whose inverse is cheap to apply. Conjugate gradients need few
// iterations if the eigenvalues of M^-1 A are few or close to each other. One object serves one
// matrix, whose numbers may change, and one thread at a time.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  // Computes M for the numbers that the matrix has now. Returns false if A is not positive
  // definite, as far as that shows.
  virtual bool Update(int num_threads) = 0;

  // Computes y = M^-1 x for a vector of the primal rows. M^-1 is symmetric and positive definite.
  // The result has the same bits at any number of threads.
  virtual void Apply(const Eigen::VectorXd& x, int num_threads, Eigen::VectorXd* y) = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_LINEAR_ALGEBRA_ITERATIVE_PRECONDITIONER_H_
