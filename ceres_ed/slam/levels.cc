#include "ceres_ed/slam/levels.h"

#include <ceres_ed/graph/node_neighborhood.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// Steps that are added where the first ones were all refused.
constexpr int kMoreSteps = 5;

// What energies look at, over a window.
struct WindowObservations {
  std::vector<Eigen::Vector3d> points;
  Skinning skinning;
  std::vector<Correspondence> planes;
  std::vector<Correspondence> features;
  std::vector<Eigen::Vector3d> node_prior;

  WindowObservations(const FrameObservations& observations,
                     const LevelWindowBuilder& windows,
                     const DeformableMap& map,
                     const LevelWindow& window)
      : skinning(map.neighbors()) {
    const std::size_t count = observations.planes.size() + observations.features.size();
    points.reserve(count);
    skinning.Reserve(count);
    planes = Take(observations.planes, windows);
    features = Take(observations.features, windows);
    node_prior.reserve(window.nodes.size());
    for (const int node : window.nodes) node_prior.push_back(map.node_prior()[node]);
  }

  EnergyContext Context(const LevelWindow& window) const {
    EnergyContext context;
    context.graph = &window.graph;
    context.points = &points;
    context.skinning = &skinning;
    context.correspondences = &planes;
    context.landmarks = &features;
    context.node_prior = &node_prior;
    return context;
  }

 private:
  std::vector<Correspondence> Take(const std::vector<MapObservation>& observations,
                                   const LevelWindowBuilder& windows) {
    std::vector<Correspondence> correspondences;
    correspondences.reserve(observations.size());
    for (const MapObservation& o : observations) {
      int nodes[kMaxBoundNodes];
      for (int i = 0; i < o.binding.size; ++i) nodes[i] = windows.Local(o.binding.nodes[i]);
      Correspondence c;
      c.point = static_cast<int>(points.size());
      c.target = o.target;
      c.normal = o.normal;
      c.weight = o.weight;
      correspondences.push_back(c);
      points.push_back(o.position);
      skinning.Add(nodes, o.binding.weights, o.binding.size);
    }
    return correspondences;
  }
};

// Observations change with every step, so that more than one on the same is wasted.
SolverOptions OneStep() {
  SolverOptions options;
  options.max_iterations = 1;
  return options;
}

}  // namespace

LevelsOptions::LevelsOptions() : solver(OneStep()) {}

StatusOr<std::unique_ptr<Levels>> Levels::Create(const LevelsOptions& options,
                                                 const EnergyRegistry& registry) {
  std::unique_ptr<Levels> levels(new Levels(options));
  std::vector<EnergySpec> specs = {
      {"rotation", options.rotation_weight, {}, {}},
      {"regularization", options.regularization_weight, {}, {}},
      {"node_prior", options.node_prior_weight, {}, {}},
      {"point_to_plane", options.plane_weight, {LossType::kTukey, 1.0}, {}},
      {"landmark", options.plane_weight * options.feature_weight, {LossType::kTukey, 1.0}, {}},
      {"pose_prior",
       1.0,
       {},
       {{"rotation_sigma", options.prior_rotation_deg},
        {"translation_sigma", options.prior_translation}}}};
  specs.insert(specs.end(), options.energies.begin(), options.energies.end());
  for (const EnergySpec& spec : specs) {
    StatusOr<std::unique_ptr<EnergyTerm>> energy = registry.Create(spec.name, spec.parameters);
    if (!energy.ok()) return energy.status();
    Term term;
    term.name = spec.name;
    term.energy = *std::move(energy);
    term.weight = spec.weight;
    term.loss = spec.loss;
    term.observation = term.energy->kind() == EnergyKind::kObservation;
    levels->terms_.push_back(std::move(term));
  }
  levels->level_one_ = MakeLevelSolver(options.linear_solver);
  levels->level_two_ = MakeLevelSolver(options.linear_solver);
  return levels;
}

void Levels::MarkPointRelevant(const FrameObservations& observations, int num_nodes) {
  point_relevant_.assign(num_nodes, 0);
  for (const auto* list : {&observations.planes, &observations.features}) {
    for (const MapObservation& o : *list) {
      for (int i = 0; i < o.binding.size; ++i) point_relevant_[o.binding.nodes[i]] = 1;
    }
  }
}

std::vector<int> Levels::VariableNodes(const DeformableMap& map) {
  if (options_.rings < 0) {
    moved_.assign(map.graph().num_nodes(), 1);
  } else {
    moved_ = RingsAround(map.graph(), point_relevant_, options_.rings);
  }
  std::vector<int> nodes;
  for (int j = 0; j < map.graph().num_nodes(); ++j) {
    if (moved_[j] != 0) nodes.push_back(j);
  }
  return nodes;
}

LevelReport Levels::SolveLevelOne(const FrameObservations& observations, DeformableMap* map) {
  MarkPointRelevant(observations, map->graph().num_nodes());
  LevelWindow window = windows_.Build(map->graph(), map->state(), VariableNodes(*map), /*held=*/{});
  const WindowObservations seen(observations, windows_, *map, window);
  // Data count per PR node, whatever the density of points.
  const int point_relevant =
      static_cast<int>(std::count(point_relevant_.begin(), point_relevant_.end(), 1));
  const double per_node =
      static_cast<double>(point_relevant) / std::max<std::size_t>(1, seen.planes.size());
  EnergyContext context = seen.Context(window);
  context.has_camera = true;
  context.camera_prior = map->state().camera_from_map;
  ProblemBuilder builder(window.graph, /*has_camera=*/true);
  for (const Term& term : terms_) {
    LossSpec loss = term.loss;
    if (term.name == "point_to_plane") loss.width = observations.plane_width;
    if (term.name == "landmark") loss.width = observations.feature_width;
    const double weight = term.weight * (term.observation ? per_node : 1.0);
    const int index = builder.AddTerm(term.name, term.energy->kind(), weight, loss);
    builder.CollectResiduals(index, *term.energy, context);
  }
  LevelReport report = Solve(builder,
                             window.Config(options_.camera_variable, options_.seam_edges),
                             level_one_.get(),
                             &window,
                             map);
  report.point_relevant = point_relevant;
  return report;
}

LevelReport Levels::SolveLevelTwo(DeformableMap* map) {
  std::vector<int> variable;
  for (int j = 0; j < map->graph().num_nodes(); ++j) {
    if (point_relevant_[j] == 0) variable.push_back(j);
  }
  if (variable.empty()) return LevelReport();
  LevelWindow window = windows_.Build(map->graph(), map->state(), variable, /*held=*/{});
  const WindowObservations nothing({}, windows_, *map, window);
  const EnergyContext context = nothing.Context(window);
  ProblemBuilder builder(window.graph, /*has_camera=*/false);
  for (const Term& term : terms_) {
    if (term.observation || term.name == "pose_prior") continue;
    const int index = builder.AddTerm(term.name, term.energy->kind(), term.weight, term.loss);
    builder.CollectResiduals(index, *term.energy, context);
  }
  return Solve(builder,
               window.Config(/*camera_variable=*/false, SeamEdges::kKeep),
               level_two_.get(),
               &window,
               map);
}

LevelReport Levels::Solve(const ProblemBuilder& builder,
                          const ProblemConfig& config,
                          LevelSolver* solver,
                          LevelWindow* window,
                          DeformableMap* map) {
  LevelReport report;
  SolverOptions options = options_.solver;
  SolveSummary summary;
  bool solved = solver->Solve(builder, config, options, &window->state, &summary);
  const auto moved = [&summary] {
    return summary.levels.back().final_cost < summary.levels.back().initial_cost;
  };
  if (solved && summary.status == SolveStatus::kMaxIterations && !moved()) {
    options.max_iterations += kMoreSteps;
    solved = solver->Solve(builder, config, options, &window->state, &summary);
  }
  report.status = summary.status;
  if (!solved) return report;
  report.variable_nodes = window->num_variable;
  report.iterations = summary.TotalIterations();
  report.initial_energy = summary.levels.back().initial_cost;
  report.energy = summary.levels.back().final_cost;
  WriteBack(*window, &map->mutable_state());
  if (config.camera_variable) {
    map->mutable_state().camera_from_map = window->state.camera_from_map;
  }
  return report;
}

}  // namespace ceres_ed
