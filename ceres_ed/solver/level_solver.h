// Solves one ProblemConfig: what the strategies are made of.
#ifndef CERES_ED_SOLVER_LEVEL_SOLVER_H_
#define CERES_ED_SOLVER_LEVEL_SOLVER_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/solver_types.h>

#include <memory>
#include <string>

namespace ceres_ed {

// A minimiser for subproblems. It may keep what helps it with the next, similar one; one object
// serves one thread at a time.
class LevelSolver {
 public:
  virtual ~LevelSolver() = default;

  // Minimises the problem of `config` over `state` and appends to `summary->levels`;
  // `summary->status` and `message` become this level's. Returns false when the level failed;
  // `state` is then as it was. A level without anything variable converges at once.
  virtual bool Solve(const ProblemBuilder& builder,
                     const ProblemConfig& config,
                     const SolverOptions& options,
                     DeformationState* state,
                     SolveSummary* summary) = 0;
};

std::unique_ptr<LevelSolver> MakeLevelSolver(LinearSolver linear_solver);

// Sets the status to failed, and says why: by the residual that is at fault at `state`, or by
// `otherwise` where none is.
void ExplainFailure(const ProblemBuilder& builder,
                    const DeformationState& state,
                    const std::string& otherwise,
                    SolveSummary* summary);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_LEVEL_SOLVER_H_
