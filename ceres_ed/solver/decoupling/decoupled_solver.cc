#include "ceres_ed/solver/decoupling/decoupled_solver.h"

#include <ceres_ed/solver/strategies/strategy_table.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <limits>
#include <string>

namespace ceres_ed {
namespace {

// A time limit, in seconds, that a solve always has.
constexpr double kLeastTime = 1e-3;

NodeSet NodesOf(const std::vector<char>& mask) {
  NodeSet nodes;
  for (std::size_t j = 0; j < mask.size(); ++j) {
    if (mask[j] != 0) nodes.Add(static_cast<int>(j));
  }
  return nodes;
}

// Returns the options of Level II. If Level I was stopped early, the PI nodes still follow by a few
// steps, whatever the time limit or the caller says, because a torn boundary would not be a usable
// state.
SolverOptions LevelTwoOptions(const SolverOptions& options,
                              const SolveSummary& level_one,
                              double time_left_s) {
  constexpr int kFollowingSteps = 3;
  SolverOptions level_two = options;
  level_two.time_limit_s = std::max(kLeastTime, time_left_s);
  if (level_one.status == SolveStatus::kTimeLimit ||
      level_one.status == SolveStatus::kInterrupted) {
    const bool moved = level_one.levels.front().iterations > 0;
    level_two.max_iterations = moved ? std::min(kFollowingSteps, options.max_iterations) : 0;
    level_two.time_limit_s = std::numeric_limits<double>::max();
    level_two.should_stop = nullptr;
  }
  return level_two;
}

}  // namespace

DecoupledSolver::DecoupledSolver(const StrategyOptions& options)
    : mode_(options.mode),
      has_active_set_(options.mode == SolveMode::kTwoLevel &&
                      options.active == ActiveSetRule::kInformation),
      decoupler_(options),
      level_one_(options),
      level_two_(options) {}

bool DecoupledSolver::HasLevelTwo() const {
  return FindStrategy(mode_).hidden != HiddenNodes::kMoveAlong;
}

bool DecoupledSolver::Eliminates() const {
  return FindStrategy(mode_).hidden == HiddenNodes::kAreEliminated;
}

SolveSummary DecoupledSolver::Solve(const ProblemBuilder& builder,
                                    const SolverOptions& options,
                                    DeformationState* state) {
  const Timer timer;
  const int num_nodes = builder.graph().num_nodes();
  const std::vector<char> point_relevant = builder.PointRelevantNodes();
  const NodeSet observed = NodesOf(point_relevant);
  // The active set is kept from problem to problem on one graph.
  if (num_nodes != num_nodes_) decoupler_.active_set().Clear();
  num_nodes_ = num_nodes;
  // Level I over the nodes that the strategy chooses, then Level II over the others.
  const Decoupling& nodes = decoupler_.Choose(builder.graph(), observed);
  const bool follows = HasLevelTwo() && (!Eliminates() || nodes.HoldsNodes(num_nodes));
  const DeformationState start = *state;
  SolveSummary summary;
  bool solved =
      has_active_set_
          ? SolveActiveSet(builder, observed, options, state, &summary)
          : SolveLevelOne(
                builder, nodes.LevelOne(num_nodes, builder.has_camera()), options, state, &summary);
  if (follows && !Eliminates()) {
    for (const int node : nodes.moved.nodes()) {
      if (point_relevant[node] == 0) summary.active_set.hidden_nodes.push_back(node);
    }
  }
  if (solved && follows) {
    const double time_left_s = options.time_limit_s - timer.Seconds();
    solved = Follow(builder, point_relevant, options, time_left_s, state, &summary);
  } else if (solved && HasLevelTwo()) {
    // There may have been no nodes to eliminate.
    summary.levels.resize(2);
  }
  if (!solved) *state = start;
  // A Level I that moves nodes and holds none contains every residual.
  if (!solved || follows || summary.levels.front().num_variable_nodes == 0) {
    summary.initial_energy = builder.Evaluate(start).Total();
    summary.final_energy = builder.Evaluate(*state).Total();
  }
  return summary;
}

// Solves Level I over PR nodes and active set. As long as it converges and the set grows, it is
// solved again over the larger set; what is released after that belongs to the next problem.
bool DecoupledSolver::SolveActiveSet(const ProblemBuilder& builder,
                                     const NodeSet& point_relevant,
                                     const SolverOptions& options,
                                     DeformationState* state,
                                     SolveSummary* summary) {
  const Timer timer;
  const int num_nodes = builder.graph().num_nodes();
  LevelSummary total;
  while (true) {
    const Decoupling& nodes = decoupler_.Choose(builder.graph(), point_relevant);
    const ProblemConfig config = nodes.LevelOne(num_nodes, builder.has_camera());
    const DeformationState before = *state;
    SolverOptions rest = options;
    rest.max_iterations -= total.iterations;
    rest.time_limit_s = std::max(kLeastTime, options.time_limit_s - timer.Seconds());
    summary->levels.clear();
    const bool solved = SolveLevelOne(builder, config, rest, state, summary);
    LevelSummary& level = summary->levels.front();
    // The costs are those of the last set.
    level.iterations += total.iterations;
    level.build_time_s += total.build_time_s;
    level.solve_time_s += total.solve_time_s;
    if (!solved) return false;
    const Timer look_timer;
    SolvedLevelOne look;
    look.builder = &builder;
    look.moved_hidden = config.variable_nodes;
    for (const int node : point_relevant.nodes()) look.moved_hidden[node] = 0;
    look.candidates.assign(num_nodes, 0);
    for (const int node : nodes.candidates.nodes()) look.candidates[node] = 1;
    look.before = &before;
    look.after = state;
    look.energy = level.final_cost;
    look.num_threads = options.num_threads;
    const int num_new = decoupler_.active_set().Look(look);
    summary->active_set.held_share = decoupler_.active_set().held_share();
    level.solve_time_s += look_timer.Seconds();
    total = level;
    if (num_new == 0 || summary->status != SolveStatus::kConverged ||
        total.iterations >= options.max_iterations) {
      return true;
    }
  }
}

// Level II (Eq. 15). The status remains that of Level I if Level I did not converge.
bool DecoupledSolver::Follow(const ProblemBuilder& builder,
                             const std::vector<char>& point_relevant,
                             const SolverOptions& options,
                             double time_left_s,
                             DeformationState* state,
                             SolveSummary* summary) {
  const SolveStatus status = summary->status;
  const std::string message = summary->message;
  const SolverOptions level_two = LevelTwoOptions(options, *summary, time_left_s);
  if (!SolveLevelTwo(builder, LevelTwoConfig(point_relevant), level_two, state, summary)) {
    return false;
  }
  if (status != SolveStatus::kConverged) {
    summary->status = status;
    summary->message = message;
  }
  return true;
}

}  // namespace ceres_ed
