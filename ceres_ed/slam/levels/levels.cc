#include "ceres_ed/slam/levels/levels.h"

#include <ceres_ed/slam/levels/window_observations.h>

#include <algorithm>
#include <map>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// The number of steps that are added if all steps were refused.
constexpr int kMoreSteps = 5;

// The energies of the levels and how they take part.
std::vector<TermSpec> OwnTerms(const LevelsOptions& options) {
  // Hidden nodes depend neither on observations nor on the camera.
  TermRule planes;
  planes.scale = WeightScale::kPerObservedNode;
  planes.levels = TermLevels::kLevelOne;
  planes.loss_width = LossWidth::kCorrespondences;
  TermRule features = planes;
  features.loss_width = LossWidth::kFeatures;
  features.pairs = PairSource::kFeatures;
  TermRule places;
  places.stiff = true;
  TermRule camera;
  camera.levels = TermLevels::kLevelOne;
  const double feature_weight = options.plane_weight * options.feature_weight;
  const std::map<std::string, double> spreads = {{"rotation_sigma", options.prior_rotation_deg},
                                                 {"translation_sigma", options.prior_translation}};
  const LossSpec tukey = {LossType::kTukey, 1.0};
  return {{"rotation", {"rotation", options.rotation_weight, {}, {}}, {}},
          {"regularization", {"regularization", options.regularization_weight, {}, {}}, {}},
          {"node_prior", {"node_prior", options.node_prior_weight, {}, {}}, places},
          {"point_to_plane", {"point_to_plane", options.plane_weight, tukey, {}}, planes},
          {"feature", {"landmark", feature_weight, tukey, {}}, features},
          {kPosePrior, {"pose_prior", 1.0, {}, spreads}, camera}};
}

// Returns the term of a user's energy: observations are weighted like those of the levels, and
// priors act on hidden nodes, too.
TermSpec UsersTerm(const EnergySpec& energy, const EnergyRegistry& registry) {
  TermSpec spec = {energy.name, energy, {}};
  spec.rule.is_users = true;
  const EnergyInfo* info = registry.Find(energy.name);
  if (info != nullptr && info->kind == EnergyKind::kObservation) {
    spec.rule.scale = WeightScale::kPerObservedNode;
    spec.rule.levels = TermLevels::kLevelOne;
  }
  return spec;
}

// Limits with which the last problem of a frame is solved until it converges.
constexpr int kConvergenceSteps = 20;
constexpr double kConvergenceTolerance = 1e-5;

// Returns the motion of a node from `before`: |dt| + |dA|.
double MotionOf(const double* before, const double* after) {
  return (NodeTranslation(after) - NodeTranslation(before)).norm() +
         (NodeAffine(after) - NodeAffine(before)).norm();
}

}  // namespace

// Observations change with every step, so that more than one on the same is wasted.
SolverOptions LevelsOptions::OneStep() {
  SolverOptions options;
  options.max_iterations = 1;
  return options;
}

// Only hidden nodes near Level I are marginalised, because the time of a frame must not grow with
// the map.
StrategyOptions LevelsOptions::TwoLevels() {
  StrategyOptions options;
  options.mode = SolveMode::kTwoLevel;
  options.marginal_reach = 8;
  return options;
}

StatusOr<std::unique_ptr<Levels>> Levels::Create(const LevelsOptions& options,
                                                 const EnergyRegistry& registry) {
  std::unique_ptr<Levels> levels(new Levels(options));
  std::vector<TermSpec> specs = OwnTerms(options);
  for (const EnergySpec& energy : options.energies) specs.push_back(UsersTerm(energy, registry));
  for (const TermSpec& spec : specs) {
    if (Status status = levels->terms_.Add(registry, spec); !status.ok()) return status;
  }
  levels->ForgetSolvers();
  return levels;
}

std::unique_ptr<DecoupledSolver> Levels::MakeSolver() const {
  StrategyOptions strategy = options_.strategy;
  // With full Level II all hidden nodes move in every frame, so all of them can be eliminated.
  if (options_.level_two == LevelTwoMode::kFull) strategy.marginal_reach = -1;
  return std::make_unique<DecoupledSolver>(strategy);
}

void Levels::MarkPointRelevant(const FrameObservations& observations) {
  point_relevant_.Clear();
  for (const auto* list : {&observations.planes, &observations.features}) {
    for (const MapObservation& o : *list) {
      for (int i = 0; i < o.binding.size; ++i) point_relevant_.Add(o.binding.nodes[i]);
    }
  }
  point_relevant_.Sort();
}

const Decoupling& Levels::ChooseNodes(const FrameObservations& observations,
                                      const DeformableMap& map) {
  MarkPointRelevant(observations);
  const Decoupling& nodes = solver_->UpdateNodes(map.graph(), point_relevant_);
  moved_.Clear();
  for (const int node : nodes.moved.nodes()) moved_.Add(node);
  moved_.Sort();
  return nodes;
}

void Levels::HoldLevelOne(const FrameObservations& observations, const DeformableMap& map) {
  ChooseNodes(observations, map);
}

LevelReport Levels::SolveLevelOne(const FrameObservations& observations,
                                  NodePriorSource* priors,
                                  DeformableMap* map) {
  return SolveLevelOne(observations, options_.solver, priors, map);
}

LevelReport Levels::ConvergeLevelOne(const FrameObservations& observations,
                                     NodePriorSource* priors,
                                     DeformableMap* map) {
  SolverOptions options = options_.solver;
  options.max_iterations = kConvergenceSteps;
  options.function_tolerance = kConvergenceTolerance;
  return SolveLevelOne(observations, options, priors, map);
}

LevelReport Levels::SolveLevelOne(const FrameObservations& observations,
                                  const SolverOptions& options,
                                  NodePriorSource* priors,
                                  DeformableMap* map) {
  const Decoupling& nodes = ChooseNodes(observations, *map);
  LevelWindow window = windows_.Build(map->graph(), map->state(), nodes);
  if (priors != nullptr) priors->UpdatePriors(window.nodes, map);
  const WindowObservations seen(observations, windows_, *map, window);
  const std::vector<Eigen::Vector3d> previous = PreviousOf(window, *map);
  ProblemBuilder builder(window.graph, /*has_camera=*/true);
  terms_.AddTo(
      LevelOneInputs(observations, seen, window, previous), TermLevels::kLevelOne, &builder);
  const bool camera = options_.camera_variable;
  const ProblemConfig config = window.Config(camera, nodes.boundary_edges);
  const auto solve = [&](const SolverOptions& steps, SolveSummary* summary) {
    return solver_->SolveLevelOne(builder, config, steps, &window.state, summary);
  };
  std::vector<double> motion;
  DeformationState before;
  if (solver_->HasActiveSet()) before = window.state;
  LevelReport report = Solve(options, solve, window, map, &motion);
  report.point_relevant = point_relevant_.size();
  report.marginalized = window.num_eliminated;
  if (report.status == SolveStatus::kFailed) return report;
  if (camera) map->SetCamera(window.state.camera_from_map);
  pending_.NoteSolve(window, map->graph(), motion, /*one_step=*/Eliminates());
  if (solver_->HasActiveSet()) LookAtFrontier(builder, window, before, &report);
  return report;
}

void Levels::LookAtFrontier(const ProblemBuilder& builder,
                            const LevelWindow& window,
                            const DeformationState& before,
                            LevelReport* report) {
  SolvedLevelOne level;
  level.builder = &builder;
  level.moved_hidden.assign(window.nodes.size(), 0);
  for (int i = 0; i < window.num_variable; ++i) {
    level.moved_hidden[i] = point_relevant_.Has(window.nodes[i]) ? 0 : 1;
  }
  level.candidates.assign(window.nodes.size(), 0);
  std::fill_n(level.candidates.begin() + window.num_variable, window.num_candidates, 1);
  level.before = &before;
  level.after = &window.state;
  level.energy = report->energy;
  level.names = &window.nodes;
  level.num_threads = options_.solver.num_threads;
  solver_->active_set().Look(level);
  report->held_share = solver_->active_set().held_share();
}

TermInputs Levels::LevelOneInputs(const FrameObservations& observations,
                                  const WindowObservations& seen,
                                  const LevelWindow& window,
                                  const std::vector<Eigen::Vector3d>& previous) const {
  TermInputs inputs;
  inputs.context = seen.Context(window);
  if (!previous.empty()) inputs.context.node_previous = &previous;
  inputs.context.has_camera = true;
  inputs.context.camera_prior = observations.camera_prior;
  inputs.stiffness = observations.node_prior_share;
  // The weight of the data is per PR node and does not depend on the density of points.
  inputs.nodes_per_observation =
      point_relevant_.size() / std::max(1.0, static_cast<double>(seen.num_planes()));
  inputs.features = &seen.features();
  inputs.correspondence_width = observations.plane_width;
  inputs.feature_width = observations.feature_width;
  return inputs;
}

std::vector<Eigen::Vector3d> Levels::PreviousOf(const LevelWindow& window,
                                                const DeformableMap& map) {
  std::vector<Eigen::Vector3d> previous;
  if (options_.energies.empty()) return previous;
  previous.reserve(window.nodes.size());
  for (const int node : window.nodes) {
    // The first window of a frame that contains the node sees its previous position.
    const auto [place, is_new] =
        previous_.try_emplace(node, NodeTranslation(map.state().node(node)));
    previous.push_back(place->second);
  }
  return previous;
}

LevelReport Levels::Solve(const SolverOptions& options,
                          const SolveWindow& solve,
                          const LevelWindow& window,
                          DeformableMap* map,
                          std::vector<double>* motion) {
  LevelReport report;
  SolveSummary summary;
  int iterations = 0;
  const auto run = [&](const SolverOptions& steps) {
    summary = SolveSummary();
    const bool solved = solve(steps, &summary);
    if (solved) iterations += summary.levels.front().iterations;
    return solved;
  };
  bool solved = run(options);
  if (solved && summary.status == SolveStatus::kMaxIterations &&
      !(summary.final_energy < summary.initial_energy)) {
    SolverOptions more = options;
    more.max_iterations += kMoreSteps;
    solved = run(more);
  }
  report.status = summary.status;
  if (!solved) {
    fault_ = summary.fault;
    return report;
  }
  report.iterations = iterations;
  report.variable_nodes = window.num_variable;
  report.initial_energy = summary.initial_energy;
  report.energy = summary.final_energy;
  motion->resize(window.num_variable);
  for (int i = 0; i < window.num_variable; ++i) {
    const int node = window.nodes[i];
    (*motion)[i] = MotionOf(map->state().node(node), window.state.node(i));
    map->SetNode(node, window.state.node(i));
  }
  return report;
}

}  // namespace ceres_ed
