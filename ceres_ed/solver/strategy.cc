#include "ceres_ed/solver/strategy.h"

#include <ceres_ed/solver/block_level_solver.h>
#include <ceres_ed/solver/ceres_level_solver.h>
#include <ceres_ed/solver/decoupling/decoupled_solver.h>
#include <ceres_ed/util/option_check.h>

namespace ceres_ed {

bool SolverOptions::IsValid(std::string* error) const {
  return RequireOption(max_iterations >= 0, "max_iterations", max_iterations, ">= 0", error) &&
         RequireOption(
             function_tolerance >= 0.0, "function_tolerance", function_tolerance, ">= 0", error) &&
         RequireOption(
             gradient_tolerance >= 0.0, "gradient_tolerance", gradient_tolerance, ">= 0", error) &&
         RequireOption(parameter_tolerance >= 0.0,
                       "parameter_tolerance",
                       parameter_tolerance,
                       ">= 0",
                       error) &&
         RequireOption(initial_trust_region_radius > 0.0,
                       "initial_trust_region_radius",
                       initial_trust_region_radius,
                       "> 0",
                       error) &&
         RequireOption(num_threads >= 1, "num_threads", num_threads, ">= 1", error) &&
         RequireOption(time_limit_s > 0.0, "time_limit_s", time_limit_s, "> 0 seconds", error);
}

bool StrategyOptions::IsValid(std::string* error) const {
  return RequireOption(rings >= 0, "rings", rings, ">= 0", error) &&
         RequireOption(
             relinearize_above >= 0.0, "relinearize_above", relinearize_above, ">= 0", error) &&
         RequireOption(marginal_reach == -1 || marginal_reach >= 1,
                       "marginal_reach",
                       marginal_reach,
                       "-1 or >= 1",
                       error);
}

std::string SolveStatusName(SolveStatus status) {
  switch (status) {
    case SolveStatus::kFailed:
      return "failed";
    case SolveStatus::kMaxIterations:
      return "max_iterations";
    case SolveStatus::kTimeLimit:
      return "time_limit";
    case SolveStatus::kInterrupted:
      return "interrupted";
    case SolveStatus::kConverged:
      return "converged";
  }
  return "failed";
}

int SolveSummary::TotalIterations() const {
  int total = 0;
  for (const LevelSummary& level : levels) total += level.iterations;
  return total;
}

std::unique_ptr<LevelSolver> MakeLevelSolver(LinearSolver linear_solver) {
  switch (linear_solver) {
    case LinearSolver::kCeres:
      return std::make_unique<CeresLevelSolver>();
    case LinearSolver::kBlock:
      return std::make_unique<BlockLevelSolver>();
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
