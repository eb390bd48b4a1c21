// Minimises one ProblemConfig with ceres::Solve; this is the reference for other solvers.
#ifndef CERES_ED_SOLVER_CERES_LEVEL_SOLVER_H_
#define CERES_ED_SOLVER_CERES_LEVEL_SOLVER_H_

#include <ceres_ed/solver/level_solver.h>

namespace ceres_ed {

// The Levenberg-Marquardt method of Ceres with SPARSE_NORMAL_CHOLESKY and the best sparse library
// that Ceres has, or with CGNR, the conjugate gradients of Ceres.
class CeresLevelSolver final : public LevelSolver {
 public:
  explicit CeresLevelSolver(bool iterative) : iterative_(iterative) {}

  bool Solve(const ProblemBuilder& builder,
             const ProblemConfig& config,
             const SolverOptions& options,
             DeformationState* state,
             SolveSummary* summary) override;

 private:
  const bool iterative_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_CERES_LEVEL_SOLVER_H_
