// Level II: the PI nodes follow, all of them or by waves.
#include <ceres_ed/graph/node_neighborhood.h>
#include <ceres_ed/slam/levels/levels.h>
#include <ceres_ed/slam/levels/window_observations.h>

#include <algorithm>
#include <utility>

namespace ceres_ed {
namespace {

// The largest number of waves. If there were more, nodes would move to and fro; the remaining
// changes are left.
constexpr int kMostWaves = 200;

// Adds the report of one wave to that of all.
void Add(const LevelReport& wave, LevelReport* all) {
  all->status = wave.status;
  all->variable_nodes += wave.variable_nodes;
  all->iterations += wave.iterations;
}

}  // namespace

LevelReport Levels::SolveHidden(const std::vector<int>& nodes,
                                NodePriorSource* priors,
                                DeformableMap* map) {
  if (nodes.empty()) return LevelReport();
  LevelWindow window = windows_.Build(map->graph(), map->state(), nodes, /*held=*/{});
  if (priors != nullptr) priors->UpdatePriors(window.nodes, map);
  const WindowObservations nothing({}, windows_, *map, window);
  TermInputs inputs;
  inputs.context = nothing.Context(window);
  const std::vector<Eigen::Vector3d> previous = PreviousOf(window, *map);
  if (!previous.empty()) inputs.context.node_previous = &previous;
  ProblemBuilder builder(window.graph, /*has_camera=*/false);
  terms_.AddTo(inputs, TermLevels::kAll, &builder);
  const ProblemConfig config = window.Config(/*camera_variable=*/false, BoundaryEdges::kKeep);
  const auto solve = [&](const SolverOptions& steps, SolveSummary* summary) {
    return solver_->SolveLevelTwo(builder, config, steps, &window.state, summary);
  };
  std::vector<double> motion;
  const LevelReport report = Solve(options_.solver, solve, window, map, &motion);
  if (report.status != SolveStatus::kFailed) {
    pending_.NoteSolve(window, map->graph(), motion, /*one_step=*/true);
  }
  return report;
}

template <typename Counts>
LevelReport Levels::SendWaves(int most,
                              Counts counts,
                              NodePriorSource* priors,
                              DeformableMap* map) {
  const auto hidden = [this](int node) { return !point_relevant_.Has(node); };
  LevelReport all;
  // Each wave solves for the unsettled nodes and the rings around them, while the others are held.
  for (int wave = 0; wave < most; ++wave) {
    std::vector<int> seeds;
    for (const int node : pending_.Unsettled()) {
      if (hidden(node) && counts(node)) seeds.push_back(node);
    }
    if (seeds.empty()) break;
    if (static_cast<int>(seeds.size()) > options_.lazy.max_seeds) {
      const auto first = [this](int a, int b) {
        return std::make_pair(-pending_.change(a), a) < std::make_pair(-pending_.change(b), b);
      };
      std::nth_element(seeds.begin(), seeds.begin() + options_.lazy.max_seeds, seeds.end(), first);
      seeds.resize(options_.lazy.max_seeds);
    }
    front_.Clear();
    for (const int node : seeds) front_.Add(node);
    AddRings(map->graph(), options_.lazy.reach, hidden, &front_);
    // A wave over most of the hidden nodes would continue to the rest, so one solve takes all of
    // them.
    const int num_nodes = map->graph().num_nodes();
    if (2 * front_.size() > num_nodes - point_relevant_.size()) {
      for (int node = 0; node < num_nodes; ++node) {
        if (hidden(node)) front_.Add(node);
      }
    }
    front_.Sort();
    const LevelReport report = SolveHidden(front_.nodes(), priors, map);
    Add(report, &all);
    if (report.status == SolveStatus::kFailed) break;
  }
  return all;
}

LevelReport Levels::SolveLevelTwo(NodePriorSource* priors, DeformableMap* map) {
  if (IsLazy()) {
    return SendWaves(
        options_.lazy.waves_per_frame, [](int) { return true; }, priors, map);
  }
  std::vector<int> hidden;
  for (int j = 0; j < map->graph().num_nodes(); ++j) {
    if (!point_relevant_.Has(j)) hidden.push_back(j);
  }
  return SolveHidden(hidden, priors, map);
}

LevelReport Levels::CatchUp(NodePriorSource* priors, DeformableMap* map) {
  if (!IsLazy()) return LevelReport();
  return SendWaves(
      kMostWaves, [](int) { return true; }, priors, map);
}

LevelReport Levels::CatchUp(const std::vector<int>& nodes,
                            NodePriorSource* priors,
                            DeformableMap* map) {
  if (!IsLazy()) return LevelReport();
  wanted_.Clear();
  for (const int node : nodes) wanted_.Add(node);
  return SendWaves(
      kMostWaves, [this](int node) { return wanted_.Has(node); }, priors, map);
}

void Levels::CatchUpCopy(NodePriorSource* priors, DeformableMap* copy) {
  const PendingNodes pending = pending_;
  std::unique_ptr<DecoupledSolver> kept = std::exchange(solver_, MakeSolver());
  CatchUp(priors, copy);
  pending_ = pending;
  solver_ = std::move(kept);
}

}  // namespace ceres_ed
