#include "ceres_ed/slam/levels/marginal_level.h"

#include <ceres_ed/graph/node_neighborhood.h>
#include <ceres_ed/solver/marginal/marginal_solve.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

// Nodes that stayed although they need not, as a share of the others, from which on it pays to
// eliminate them, too.
constexpr double kMostIdle = 0.5;

}  // namespace

MarginalLevel::MarginalLevel(const StrategyOptions& options)
    : options_(options), level_one_(MakeLevelSolver(options.linear_solver)) {}

bool MarginalLevel::StillServes(const NodeSet& point_relevant) const {
  if (kept_.empty()) return false;
  for (const int node : point_relevant.nodes()) {
    if (is_eliminated_.Has(node)) return false;
  }
  return is_kept_.size() <= (1.0 + kMostIdle) * point_relevant.size() + 1.0;
}

void MarginalLevel::Choose(const DeformationGraph& graph, const NodeSet& point_relevant) {
  if (StillServes(point_relevant)) {
    for (const int node : point_relevant.nodes()) {
      if (is_kept_.Add(node)) kept_.push_back(node);
    }
    return;
  }
  ++num_choices_;
  is_kept_.Clear();
  for (const int node : point_relevant.nodes()) is_kept_.Add(node);
  AddRings(
      graph, options_.rings, [](int) { return true; }, &is_kept_);
  is_kept_.Sort();
  kept_ = is_kept_.nodes();
  reached_.Clear();
  for (const int node : kept_) reached_.Add(node);
  if (options_.marginal_reach < 0) {
    for (int node = 0; node < graph.num_nodes(); ++node) reached_.Add(node);
  } else {
    AddRings(
        graph, options_.marginal_reach, [](int) { return true; }, &reached_);
  }
  is_eliminated_.Clear();
  for (const int node : reached_.nodes()) {
    if (!is_kept_.Has(node)) is_eliminated_.Add(node);
  }
  is_eliminated_.Sort();
  eliminated_ = is_eliminated_.nodes();
}

bool MarginalLevel::Solve(const ProblemBuilder& builder,
                          bool camera_variable,
                          const SolverOptions& options,
                          LevelWindow* window,
                          SolveSummary* summary) {
  const Timer timer;
  const auto num_eliminated = static_cast<std::ptrdiff_t>(eliminated_.size());
  ProblemConfig eliminated = window->Config(/*camera_variable=*/false, SeamEdges::kKeep);
  std::fill(eliminated.variable_nodes.begin() + num_eliminated, eliminated.variable_nodes.end(), 0);
  MarginalProblem problem;
  problem.builder = &builder;
  problem.level_one = window->Config(camera_variable, SeamEdges::kKeep);
  std::fill_n(problem.level_one.variable_nodes.begin(), num_eliminated, 0);
  if (eliminated_.empty()) {
    return level_one_->Solve(builder, problem.level_one, options, &window->state, summary);
  }
  problem.level_one.eliminated_nodes = eliminated.variable_nodes;
  problem.options = &options;
  problem.relinearize_above = options_.relinearize_above;
  problem.timer = &timer;
  // A prior of the user's that joins a hidden node to the camera: all of them at once, then, which
  // has the same minimum.
  if (!marginalization_.SetProblem(builder, eliminated).ok()) {
    const ProblemConfig all = window->Config(camera_variable, SeamEdges::kKeep);
    return level_one_->Solve(builder, all, options, &window->state, summary);
  }
  DeformationState solution = window->state;
  MarginalSolve solve(problem, level_one_.get(), &marginalization_, &solution);
  solve.Iterate(summary);
  LevelSummary level = solve.level_one();
  level.initial_cost = solve.initial_energy();
  level.final_cost = solve.energy();
  summary->levels.push_back(level);
  if (!summary->IsUsable() || !solve.energy_known()) return false;
  window->state = std::move(solution);
  return true;
}

}  // namespace ceres_ed
