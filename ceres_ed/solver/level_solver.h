// The interface of a minimiser for one ProblemConfig; the strategies are built from such
// minimisers.
#ifndef CERES_ED_SOLVER_LEVEL_SOLVER_H_
#define CERES_ED_SOLVER_LEVEL_SOLVER_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/solver_types.h>

#include <memory>
#include <string>

namespace ceres_ed {

// A minimiser for one part of a problem. It may keep data that help with the next, similar part.
// One object serves one thread at a time.
class LevelSolver {
 public:
  virtual ~LevelSolver() = default;

  // Minimises the problem of `config` over `state`. Appends an entry to `summary->levels`, and sets
  // `summary->status` and `message` for this level. Returns false if the level failed; `state` is
  // then unchanged. A level in which nothing is variable converges at once.
  virtual bool Solve(const ProblemBuilder& builder,
                     const ProblemConfig& config,
                     const SolverOptions& options,
                     DeformationState* state,
                     SolveSummary* summary) = 0;
};

// Returns the minimiser that uses `linear_solver`, with `preconditioner` where it is iterative.
std::unique_ptr<LevelSolver> MakeLevelSolver(
    LinearSolver linear_solver, PreconditionerKind preconditioner = PreconditionerKind::kTwoLevel);

// Sets the status to failed, with a reason: the residual that cannot be evaluated at `state`, or
// `otherwise` if there is none.
void ExplainFailure(const ProblemBuilder& builder,
                    const DeformationState& state,
                    const std::string& otherwise,
                    SolveSummary* summary);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_LEVEL_SOLVER_H_
