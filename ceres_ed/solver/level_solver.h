// Solves one ProblemConfig with Ceres: what the strategies are made of.
#ifndef CERES_ED_SOLVER_LEVEL_SOLVER_H_
#define CERES_ED_SOLVER_LEVEL_SOLVER_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/strategy.h>

namespace ceres_ed {

// Builds the problem of `config`, minimises it over `state` and appends to `summary->levels`.
// `summary->status` and `message` become this level's. Returns false when the level failed; `state`
// is then as it was. A level without anything variable converges at once.
bool SolveLevel(const ProblemBuilder& builder,
                const ProblemConfig& config,
                const SolverOptions& options,
                DeformationState* state,
                SolveSummary* summary);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_LEVEL_SOLVER_H_
