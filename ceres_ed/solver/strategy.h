// How a problem is solved: batch, two-level and marginal share one interface.
#ifndef CERES_ED_SOLVER_STRATEGY_H_
#define CERES_ED_SOLVER_STRATEGY_H_
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/solver_types.h>

#include <memory>

namespace ceres_ed {

// A way to solve. One object serves any number of problems, one at a time: it keeps what helps with
// the next, similar one.
class Strategy {
 public:
  virtual ~Strategy() = default;

  // Moves `state` to a lower energy of `builder`'s problem. When it fails, `state` is unchanged.
  virtual SolveSummary Solve(const ProblemBuilder& builder,
                             const SolverOptions& options,
                             DeformationState* state) = 0;
};

// The strategy of valid options.
std::unique_ptr<Strategy> MakeStrategy(const StrategyOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGY_H_
