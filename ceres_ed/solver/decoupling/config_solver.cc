#include "ceres_ed/solver/decoupling/config_solver.h"

#include <ceres_ed/solver/marginal/marginal_solve.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

// Returns a config whose variable nodes are the eliminated nodes of `config`.
ProblemConfig EliminatedOf(const ProblemConfig& config) {
  ProblemConfig eliminated;
  eliminated.variable_nodes = config.eliminated_nodes;
  return eliminated;
}

// Moves nodes that share a residual with the camera from the eliminated to the variable nodes. Such
// a residual is a prior of a user's energy.
void KeepNodesOfCamera(const ProblemBuilder& builder, ProblemConfig* config) {
  const auto is_camera = [](const BlockRef& b) { return b.kind != BlockRef::Kind::kNode; };
  for (const SelectedResidual& residual : builder.Select(EliminatedOf(*config))) {
    const BlockRef* end = residual.blocks + residual.num_blocks;
    if (std::none_of(residual.blocks, end, is_camera)) continue;
    for (const BlockRef* block = residual.blocks; block != end; ++block) {
      if (is_camera(*block) || config->eliminated_nodes[block->node] == 0) continue;
      config->eliminated_nodes[block->node] = 0;
      config->variable_nodes[block->node] = 1;
    }
  }
}

}  // namespace

ConfigSolver::ConfigSolver(const StrategyOptions& options)
    : relinearize_above_(options.relinearize_above),
      solver_(MakeLevelSolver(options.linear_solver, options.preconditioner)) {}

bool ConfigSolver::SolveVariable(const ProblemBuilder& builder,
                                 const ProblemConfig& config,
                                 const SolverOptions& options,
                                 DeformationState* state,
                                 SolveSummary* summary) {
  const bool solved = solver_->Solve(builder, config, options, state, summary);
  summary->initial_energy = summary->levels.back().initial_cost;
  summary->final_energy = summary->levels.back().final_cost;
  return solved;
}

bool ConfigSolver::SetMarginalization(const ProblemBuilder& builder,
                                      ProblemConfig* config,
                                      SolveSummary* summary) {
  if (!builder.status().ok()) {
    summary->message = summary->fault = builder.status().message();
    return false;
  }
  if (marginalization_.SetProblem(builder, EliminatedOf(*config)).ok()) return true;
  KeepNodesOfCamera(builder, config);
  const Status status = marginalization_.SetProblem(builder, EliminatedOf(*config));
  summary->message = status.message();
  return status.ok();
}

bool ConfigSolver::Solve(const ProblemBuilder& builder,
                         const ProblemConfig& config,
                         const SolverOptions& options,
                         DeformationState* state,
                         SolveSummary* summary) {
  if (config.eliminated_nodes.empty()) {
    return SolveVariable(builder, config, options, state, summary);
  }
  const Timer timer;
  MarginalProblem problem;
  problem.builder = &builder;
  problem.level_one = config;
  problem.options = &options;
  problem.relinearize_above = relinearize_above_;
  problem.timer = &timer;
  summary->status = SolveStatus::kFailed;
  if (!SetMarginalization(builder, &problem.level_one, summary)) return false;
  if (marginalization_.eliminated_nodes().empty()) {
    problem.level_one.eliminated_nodes.clear();
    return SolveVariable(builder, problem.level_one, options, state, summary);
  }
  const double build_time_s = timer.Seconds();
  DeformationState solution = *state;
  MarginalSolve solve(problem, solver_.get(), &marginalization_, &solution);
  solve.Iterate(summary);
  if (!summary->IsUsable() && summary->fault.empty()) {
    ExplainFailure(builder, *state, summary->message, summary);
  }
  summary->levels.push_back(solve.level_one());
  summary->levels.push_back(solve.level_two());
  summary->levels.back().build_time_s = build_time_s;
  summary->initial_energy = summary->final_energy =
      solve.energy_known() ? solve.initial_energy() : builder.Evaluate(*state).Total();
  if (!summary->IsUsable() || !solve.energy_known()) return summary->IsUsable();
  summary->final_energy = solve.energy();
  *state = std::move(solution);
  return true;
}

}  // namespace ceres_ed
