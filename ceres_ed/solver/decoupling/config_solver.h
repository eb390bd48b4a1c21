// Solves a ProblemConfig whose eliminated nodes follow by back-substitution.
#ifndef CERES_ED_SOLVER_DECOUPLING_CONFIG_SOLVER_H_
#define CERES_ED_SOLVER_DECOUPLING_CONFIG_SOLVER_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/solver/solver_types.h>

#include <memory>

namespace ceres_ed {

// Minimises over the variable and the eliminated nodes of one config after another, and keeps what
// helps with the next, similar one.
//
// Without eliminated nodes it is a LevelSolver. With them, each iteration eliminates these nodes at
// the present state, takes a step over the variable ones with the prior that the others leave on
// the seam, and lets the others follow by back-substitution. Together that is a Gauss-Newton step
// over both, so that the minimum is the one that moving them all would have.
//
// The cost of an elimination grows with the number of eliminated nodes; that of a step over the
// variable ones does not. The elimination is kept, for the next iteration and the next solve, while
// the eliminated nodes stay near where it was made and the weights are the same: only their
// gradient is worked out again, so that it converges to the same minimum.
//
// A step that doesn't lower the energy is undone, and damped more. Where eliminated nodes have
// nothing that settles them, damping alone does.
class ConfigSolver {
 public:
  // Of the options it looks at linear_solver and relinearize_above.
  explicit ConfigSolver(const StrategyOptions& options);

  // Minimises the problem of `config` over `state`, and appends the variable nodes to
  // `summary->levels`, then the eliminated ones with the cost of their residuals, if there are any.
  // The energies of the summary become those of all residuals of the config. Nodes that share a
  // residual with the camera are moved and not eliminated. False, and `state` is as it was, when it
  // fails.
  bool Solve(const ProblemBuilder& builder,
             const ProblemConfig& config,
             const SolverOptions& options,
             DeformationState* state,
             SolveSummary* summary);

  const Marginalization& marginalization() const { return marginalization_; }

 private:
  bool SolveVariable(const ProblemBuilder& builder,
                     const ProblemConfig& config,
                     const SolverOptions& options,
                     DeformationState* state,
                     SolveSummary* summary);
  bool SetMarginalization(const ProblemBuilder& builder,
                          ProblemConfig* config,
                          SolveSummary* summary);

  double relinearize_above_;
  std::unique_ptr<LevelSolver> solver_;
  Marginalization marginalization_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_DECOUPLING_CONFIG_SOLVER_H_
