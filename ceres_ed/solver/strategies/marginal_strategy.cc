#include "ceres_ed/solver/strategies/marginal_strategy.h"

#include <ceres_ed/solver/marginal/marginal_solve.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

// What shares a residual with the camera stays beside it: a prior of an energy of the user's, on
// points or nodes that nothing observes.
void KeepNodesOfCamera(const ProblemBuilder& builder, ProblemConfig* level_one) {
  if (!builder.has_camera()) return;
  const ProblemConfig full = FullConfig(builder.graph().num_nodes(), /*has_camera=*/true);
  for (const SelectedResidual& residual : builder.Select(full)) {
    const BlockRef* end = residual.blocks + residual.num_blocks;
    const auto is_camera = [](const BlockRef& b) { return b.kind != BlockRef::Kind::kNode; };
    if (std::none_of(residual.blocks, end, is_camera)) continue;
    for (const BlockRef* block = residual.blocks; block != end; ++block) {
      if (!is_camera(*block)) level_one->variable_nodes[block->node] = 1;
    }
  }
}

}  // namespace

MarginalStrategy::MarginalStrategy(const StrategyOptions& options)
    : options_(options), level_one_(MakeLevelSolver(options.linear_solver)) {}

// Every node is variable or nothing touches it: there is but one level.
void MarginalStrategy::SolveWithoutElimination(const ProblemBuilder& builder,
                                               const ProblemConfig& level_one,
                                               const SolverOptions& options,
                                               DeformationState* state,
                                               SolveSummary* summary) {
  const double before = builder.Evaluate(*state).Total();
  summary->initial_energy = before;
  const bool solved = level_one_->Solve(builder, level_one, options, state, summary);
  summary->levels.resize(2);
  summary->final_energy = solved ? builder.Evaluate(*state).Total() : before;
}

SolveSummary MarginalStrategy::Solve(const ProblemBuilder& builder,
                                     const SolverOptions& options,
                                     DeformationState* state) {
  const Timer timer;
  SolveSummary summary;
  MarginalProblem problem;
  problem.builder = &builder;
  problem.level_one = LevelOneConfig(builder.graph(),
                                     builder.PointRelevantNodes(),
                                     builder.has_camera(),
                                     SeamEdges::kKeep,
                                     options_.rings);
  problem.options = &options;
  problem.relinearize_above = options_.relinearize_above;
  problem.timer = &timer;
  KeepNodesOfCamera(builder, &problem.level_one);
  const ProblemConfig eliminated = LevelTwoConfig(problem.level_one.variable_nodes);
  Status status = builder.status();
  if (status.ok()) status = marginalization_.SetProblem(builder, eliminated);
  if (!status.ok()) {
    summary.message = status.message();
    summary.initial_energy = summary.final_energy = builder.Evaluate(*state).Total();
    return summary;
  }
  if (marginalization_.eliminated_nodes().empty()) {
    SolveWithoutElimination(builder, problem.level_one, options, state, &summary);
    return summary;
  }
  problem.level_one.eliminated_nodes = eliminated.variable_nodes;
  const double build_time_s = timer.Seconds();
  DeformationState solution = *state;
  MarginalSolve solve(problem, level_one_.get(), &marginalization_, &solution);
  solve.Iterate(&summary);
  if (!summary.IsUsable() && summary.fault.empty()) {
    ExplainFailure(builder, *state, summary.message, &summary);
  }
  summary.levels = {solve.level_one(), solve.level_two()};
  summary.levels.back().build_time_s = build_time_s;
  summary.initial_energy =
      solve.energy_known() ? solve.initial_energy() : builder.Evaluate(*state).Total();
  summary.final_energy = summary.initial_energy;
  if (summary.IsUsable() && solve.energy_known()) {
    summary.final_energy = solve.energy();
    *state = std::move(solution);
  }
  return summary;
}

}  // namespace ceres_ed
