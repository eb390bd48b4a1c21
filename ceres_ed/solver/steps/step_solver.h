// The interface of what solves for one step of the Levenberg-Marquardt method.
#ifndef CERES_ED_SOLVER_STEPS_STEP_SOLVER_H_
#define CERES_ED_SOLVER_STEPS_STEP_SOLVER_H_

#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/linear_algebra/double_buffer.h>
#include <ceres_ed/solver/solver_types.h>

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// One damped linear system (H + diag(damping)) x = rhs. The vectors have the rows of the structure
// for which the solver was made, and H has its layout. Rows of dual blocks have no damping and no
// right side.
struct StepSystem {
  const double* values = nullptr;
  const Eigen::VectorXd* damping = nullptr;
  const Eigen::VectorXd* rhs = nullptr;
  // How exact the step must be: an iterative solver may end at this relative residual, > 0.
  double tolerance = 1e-2;
  int num_threads = 1;
  // If it returns true, an iterative solver ends with what it has.
  const std::function<bool()>* should_stop = nullptr;
};

// A solver of such systems with one structure. It may keep data from one system to the next. One
// object serves one thread at a time.
class StepSolver {
 public:
  virtual ~StepSolver() = default;

  // Computes x; the entries of dual rows have no meaning. Whatever the tolerance, x^T (H +
  // diag(damping)) x = x^T rhs. Returns false if the matrix is not positive definite. The result
  // has the same bits at any number of threads.
  virtual bool Solve(const StepSystem& system, Eigen::VectorXd* x) = 0;
};

// Returns the solver that factorises the matrix (block_cholesky.h). The arguments must outlive it.
std::unique_ptr<StepSolver> MakeFactorStep(const BlockStructure& structure, FactorMemory* memory);

// Returns the solver by conjugate gradients. `positions` has the place of each node, in the order
// of the first blocks of `structure`, which must outlive the solver.
std::unique_ptr<StepSolver> MakeGradientStep(const BlockStructure& structure,
                                             const std::vector<Eigen::Vector3d>& positions,
                                             PreconditionerKind preconditioner);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STEPS_STEP_SOLVER_H_
