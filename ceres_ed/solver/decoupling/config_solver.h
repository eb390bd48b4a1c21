// Minimises a ProblemConfig; its eliminated nodes follow by back-substitution.
#ifndef CERES_ED_SOLVER_DECOUPLING_CONFIG_SOLVER_H_
#define CERES_ED_SOLVER_DECOUPLING_CONFIG_SOLVER_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/solver/solver_types.h>

#include <memory>

namespace ceres_ed {

// Minimises over the variable and the eliminated nodes of one config after another, and keeps data
// that help with the next, similar one.
//
// Without eliminated nodes it is a LevelSolver. With them, each iteration eliminates these nodes at
// the present state (Eq. 20), takes a step over the variable nodes with the resulting prior on the
// boundary, and computes the eliminated nodes by back-substitution (Eq. 21). Together this is a
// Gauss-Newton step over all of these nodes, so that the minimum is the one of a solve that moves
// all of them.
//
// The cost of an elimination grows with the number of eliminated nodes; the cost of a step over the
// variable nodes does not. The elimination is used again in the next iteration and in the next
// solve as long as the eliminated nodes stay near their state at the elimination and the weights
// are the same. Only their gradient is computed again, so that the solve converges to the same
// minimum.
//
// A step that does not decrease the energy is undone, and the next one is damped more. If nothing
// else determines eliminated nodes, the damping does.
class ConfigSolver {
 public:
  // Uses only linear_solver and relinearize_above of the options.
  explicit ConfigSolver(const StrategyOptions& options);

  // Minimises the problem of `config` over `state`. Appends the summary of the variable nodes to
  // `summary->levels` and, if there are eliminated nodes, a second one with the cost of their
  // residuals. The energies of the summary are those of all residuals of the config. Nodes that
  // share a residual with the camera are moved and not eliminated. Returns false if it fails;
  // `state` is then unchanged.
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
