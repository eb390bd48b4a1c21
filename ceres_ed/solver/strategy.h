// The interface by which a problem is solved; batch, two-level and marginal share it.
#ifndef CERES_ED_SOLVER_STRATEGY_H_
#define CERES_ED_SOLVER_STRATEGY_H_
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/solver_types.h>

#include <memory>

namespace ceres_ed {

// A method to solve problems. One object solves any number of problems, one at a time, and keeps
// data that help with the next, similar one.
class Strategy {
 public:
  virtual ~Strategy() = default;

  // Moves `state` to a lower energy of the problem of `builder`, and returns a summary. If it
  // fails, `state` is unchanged.
  virtual SolveSummary Solve(const ProblemBuilder& builder,
                             const SolverOptions& options,
                             DeformationState* state) = 0;
};

// Returns the strategy for `options`, which must be valid.
std::unique_ptr<Strategy> MakeStrategy(const StrategyOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGY_H_
