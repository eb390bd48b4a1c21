#include "ceres_ed/slam/levels/levels.h"

#include <ceres_ed/graph/node_neighborhood.h>
#include <ceres_ed/slam/levels/window_observations.h>
#include <ceres_ed/util/option_check.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// Steps that are added where the first ones were all refused.
constexpr int kMoreSteps = 5;

// Observations change with every step, so that more than one on the same is wasted.
SolverOptions OneStep() {
  SolverOptions options;
  options.max_iterations = 1;
  return options;
}

// Of the hidden nodes only those that are near Level I are marginalised: a frame's time must not
// grow with the map.
StrategyOptions TwoLevels() {
  StrategyOptions options;
  options.mode = SolveMode::kTwoLevel;
  options.marginal_reach = 8;
  return options;
}

// Where a frame's last problem is solved to its end.
constexpr int kFinishSteps = 20;
constexpr double kFinishTolerance = 1e-5;

// How far a node went from `before`: |dt| + |dA|.
double MotionOf(const double* before, const double* after) {
  return (NodeTranslation(after) - NodeTranslation(before)).norm() +
         (NodeAffine(after) - NodeAffine(before)).norm();
}

}  // namespace

LevelsOptions::LevelsOptions() : strategy(TwoLevels()), solver(OneStep()) {}

bool LevelsOptions::IsValid(std::string* error) const {
  const auto require = [error](bool holds, const char* option, double value, const char* expected) {
    return RequireOption(holds, option, value, expected, error);
  };
  const auto weight = [&require](const char* option, double value) {
    return require(std::isfinite(value) && value >= 0.0, option, value, "finite and >= 0");
  };
  const auto spread = [&require](const char* option, double value) {
    return require(std::isfinite(value) && value > 0.0, option, value, "finite and > 0");
  };
  return weight("rotation_weight", rotation_weight) &&
         weight("regularization_weight", regularization_weight) &&
         weight("node_prior_weight", node_prior_weight) && weight("plane_weight", plane_weight) &&
         weight("feature_weight", feature_weight) &&
         spread("prior_rotation_deg", prior_rotation_deg) &&
         spread("prior_translation", prior_translation) && strategy.IsValid(error) &&
         lazy.IsValid(error) && solver.IsValid(error);
}

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
  const std::size_t num_own = specs.size();
  specs.insert(specs.end(), options.energies.begin(), options.energies.end());
  for (const EnergySpec& spec : specs) {
    StatusOr<std::unique_ptr<EnergyTerm>> energy = registry.Create(spec.name, spec.parameters);
    if (!energy.ok()) return energy.status();
    Term term;
    term.name = spec.name;
    term.origin = registry.Find(spec.name)->origin;
    term.energy = *std::move(energy);
    term.weight = spec.weight;
    term.loss = spec.loss;
    term.observation = term.energy->kind() == EnergyKind::kObservation;
    term.is_users = levels->terms_.size() >= num_own;
    levels->terms_.push_back(std::move(term));
  }
  levels->ForgetSolvers();
  return levels;
}

void Levels::MakeMarginal() {
  if (options_.strategy.mode != SolveMode::kMarginal) return;
  StrategyOptions strategy = options_.strategy;
  if (options_.level_two == LevelTwoMode::kFull) strategy.marginal_reach = -1;
  marginal_ = std::make_unique<MarginalLevel>(strategy);
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

void Levels::MarkMoved(const DeformableMap& map) {
  moved_.Clear();
  if (options_.strategy.mode == SolveMode::kBatch) {
    for (int j = 0; j < map.graph().num_nodes(); ++j) moved_.Add(j);
    return;
  }
  for (const int node : point_relevant_.nodes()) moved_.Add(node);
  AddRings(
      map.graph(), options_.strategy.rings, [](int) { return true; }, &moved_);
  moved_.Sort();
}

std::vector<int> Levels::ChooseNodes(const FrameObservations& observations,
                                     const DeformableMap& map) {
  MarkPointRelevant(observations);
  if (marginal_ == nullptr) {
    MarkMoved(map);
    return moved_.nodes();
  }
  marginal_->Choose(map.graph(), point_relevant_);
  moved_.Clear();
  for (const int node : marginal_->kept()) moved_.Add(node);
  moved_.Sort();
  std::vector<int> nodes = marginal_->eliminated();
  nodes.insert(nodes.end(), marginal_->kept().begin(), marginal_->kept().end());
  return nodes;
}

LevelReport Levels::SolveLevelOne(const FrameObservations& observations,
                                  NodePriorSource* priors,
                                  DeformableMap* map) {
  return SolveLevelOne(observations, options_.solver, priors, map);
}

LevelReport Levels::FinishLevelOne(const FrameObservations& observations,
                                   NodePriorSource* priors,
                                   DeformableMap* map) {
  SolverOptions options = options_.solver;
  options.max_iterations = kFinishSteps;
  options.function_tolerance = kFinishTolerance;
  return SolveLevelOne(observations, options, priors, map);
}

LevelReport Levels::SolveLevelOne(const FrameObservations& observations,
                                  const SolverOptions& options,
                                  NodePriorSource* priors,
                                  DeformableMap* map) {
  LevelWindow window =
      windows_.Build(map->graph(), map->state(), ChooseNodes(observations, *map), /*held=*/{});
  if (priors != nullptr) priors->UpdatePriors(window.nodes, map);
  const WindowObservations seen(observations, windows_, *map, window);
  // Data count per PR node, whatever the density of points.
  const double per_node =
      point_relevant_.size() / std::max(1.0, static_cast<double>(seen.num_planes()));
  EnergyContext context = seen.Context(window);
  const std::vector<Eigen::Vector3d> previous = PreviousOf(window, *map);
  if (!previous.empty()) context.node_previous = &previous;
  context.has_camera = true;
  context.camera_prior = observations.camera_prior;
  ProblemBuilder builder(window.graph, /*has_camera=*/true);
  for (Term& term : terms_) {
    LossSpec loss = term.loss;
    if (term.name == "point_to_plane") loss.width = observations.plane_width;
    if (term.name == "landmark") loss.width = observations.feature_width;
    const double weight = term.weight * (term.observation ? per_node : 1.0);
    Collect(weight, loss, context, &term, &builder);
  }
  const bool camera = options_.camera_variable;
  const auto solve = [&](const SolverOptions& steps, SolveSummary* summary) {
    if (marginal_ != nullptr) {
      return marginal_->Solve(builder, camera, steps, &window, summary);
    }
    const ProblemConfig config = window.Config(camera, options_.strategy.seam_edges);
    return level_one_->Solve(builder, config, steps, &window.state, summary);
  };
  std::vector<double> motion;
  LevelReport report = Solve(options, solve, window, map, &motion);
  report.point_relevant = point_relevant_.size();
  if (marginal_ != nullptr) report.marginalized = static_cast<int>(marginal_->eliminated().size());
  if (report.status == SolveStatus::kFailed) return report;
  if (camera) map->SetCamera(window.state.camera_from_map);
  pending_.NoteSolve(window, map->graph(), motion, /*one_step=*/marginal_ != nullptr);
  return report;
}

std::vector<Eigen::Vector3d> Levels::PreviousOf(const LevelWindow& window,
                                                const DeformableMap& map) {
  std::vector<Eigen::Vector3d> previous;
  if (options_.energies.empty()) return previous;
  previous.reserve(window.nodes.size());
  for (const int node : window.nodes) {
    // The first window of the frame that has it sees it as it was.
    const auto [place, is_new] =
        previous_.try_emplace(node, NodeTranslation(map.state().node(node)));
    previous.push_back(place->second);
  }
  return previous;
}

void Levels::Collect(double weight,
                     const LossSpec& loss,
                     const EnergyContext& context,
                     Term* term,
                     ProblemBuilder* builder) {
  const int index = builder->AddTerm(term->name, term->energy->kind(), weight, loss);
  builder->SetOrigin(index, term->origin);
  builder->CollectResiduals(index, *term->energy, context);
  term->has_added = term->has_added || builder->NumResidualBlocks(index) > 0;
}

std::vector<std::string> Levels::IdleEnergies() const {
  std::vector<std::string> names;
  for (const Term& term : terms_) {
    if (term.is_users && !term.has_added) names.push_back(term.name);
  }
  return names;
}

LevelReport Levels::Solve(const SolverOptions& options,
                          const SolveWindow& solve,
                          const LevelWindow& window,
                          DeformableMap* map,
                          std::vector<double>* motion) {
  LevelReport report;
  SolveSummary summary;
  bool solved = solve(options, &summary);
  const auto moved = [&summary] {
    return summary.levels.back().final_cost < summary.levels.back().initial_cost;
  };
  if (solved && summary.status == SolveStatus::kMaxIterations && !moved()) {
    SolverOptions more = options;
    more.max_iterations += kMoreSteps;
    solved = solve(more, &summary);
  }
  report.status = summary.status;
  if (!solved) {
    fault_ = summary.fault;
    return report;
  }
  report.variable_nodes = window.num_variable;
  report.iterations = summary.TotalIterations();
  report.initial_energy = summary.levels.back().initial_cost;
  report.energy = summary.levels.back().final_cost;
  motion->resize(window.num_variable);
  for (int i = 0; i < window.num_variable; ++i) {
    const int node = window.nodes[i];
    (*motion)[i] = MotionOf(map->state().node(node), window.state.node(i));
    map->SetNode(node, window.state.node(i));
  }
  return report;
}

}  // namespace ceres_ed
