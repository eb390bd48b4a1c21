#include "ceres_ed/solver/strategy.h"

#include <ceres_ed/solver/block_level_solver.h>
#include <ceres_ed/solver/ceres_level_solver.h>
#include <ceres_ed/solver/decoupling/decoupled_solver.h>

namespace ceres_ed {

int SolveSummary::TotalIterations() const {
  int total = 0;
  for (const LevelSummary& level : levels) total += level.iterations;
  return total;
}

std::unique_ptr<LevelSolver> MakeLevelSolver(LinearSolver linear_solver,
                                             PreconditionerKind preconditioner) {
  switch (linear_solver) {
    case LinearSolver::kCeres:
    case LinearSolver::kCeresCgnr:
      return std::make_unique<CeresLevelSolver>(linear_solver == LinearSolver::kCeresCgnr);
    case LinearSolver::kBlock:
    case LinearSolver::kPcg:
    case LinearSolver::kAuto:
      return std::make_unique<BlockLevelSolver>(linear_solver, preconditioner);
  }
  LOG(FATAL) << "unknown linear solver";
}

void ExplainFailure(const ProblemBuilder& builder,
                    const DeformationState& state,
                    const std::string& otherwise,
                    SolveSummary* summary) {
  summary->status = SolveStatus::kFailed;
  summary->fault = builder.CheckResiduals(state).message();
  summary->message = summary->fault.empty() ? otherwise : summary->fault;
}

std::unique_ptr<Strategy> MakeStrategy(const StrategyOptions& options) {
  return std::make_unique<DecoupledSolver>(options);
}

}  // namespace ceres_ed
