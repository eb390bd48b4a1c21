// Exact marginalisation of the PI nodes (Eq. 18 to 21), as a strategy.
#ifndef CERES_ED_SOLVER_STRATEGIES_MARGINAL_STRATEGY_H_
#define CERES_ED_SOLVER_STRATEGIES_MARGINAL_STRATEGY_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/solver/strategy.h>

#include <memory>

namespace ceres_ed {

// Each iteration eliminates the PI nodes at the present state, takes a step of Level I with the
// prior that they leave on the seam, and lets them follow by back-substitution. Together that is a
// Gauss-Newton step of the full problem, so that the minimum is that of the batch solve.
//
// What an elimination costs grows with the map; that of a step of Level I does not. The elimination
// is kept, for the next iteration and the next solve, while the PI nodes stay near where it was
// made and the weights are the same: only their gradient is worked out again, so that what it
// converges to is the same minimum.
//
// A step that doesn't lower the full energy is undone, and damped more. Where PI nodes have nothing
// that settles them, damping alone does.
class MarginalStrategy final : public Strategy {
 public:
  // Of the options: rings, linear_solver and relinearize_above.
  explicit MarginalStrategy(const StrategyOptions& options);

  SolveSummary Solve(const ProblemBuilder& builder,
                     const SolverOptions& options,
                     DeformationState* state) override;

  const Marginalization& marginalization() const { return marginalization_; }

 private:
  void SolveWithoutElimination(const ProblemBuilder& builder,
                               const ProblemConfig& level_one,
                               const SolverOptions& options,
                               DeformationState* state,
                               SolveSummary* summary);

  StrategyOptions options_;
  std::unique_ptr<LevelSolver> level_one_;
  Marginalization marginalization_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGIES_MARGINAL_STRATEGY_H_
