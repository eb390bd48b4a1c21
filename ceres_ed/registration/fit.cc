#include "ceres_ed/registration/fit.h"

#include <ceres_ed/energy/builtin_energies.h>
#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/nonrigid_loop.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

namespace ceres_ed {
namespace {

// Source and target whose diagonals differ by more than this share no scale: millimetres against
// metres is 1000, a partial view of a body seldom less than a tenth of it.
constexpr double kMaxScaleRatio = 25.0;
constexpr int kMinPoints = 4;
constexpr int kMaxLevels = 5;

Status CheckIndex(const char* what, int point, std::size_t size) {
  if (point >= 0 && point < static_cast<int>(size)) return Status::Ok();
  return Status::Error(std::string(what) + " names source point " + std::to_string(point) +
                       ", the source has " + std::to_string(size));
}

Status CheckInput(const FitInput& input) {
  if (input.source.size() < kMinPoints) {
    return Status::Error("the source has " + std::to_string(input.source.size()) +
                         " points, a fit needs at least " + std::to_string(kMinPoints));
  }
  if (input.target.empty() && input.landmarks.empty()) {
    return Status::Error("a fit needs a target or landmarks");
  }
  if (!input.target.empty() && input.target.size() < kMinPoints) {
    return Status::Error("the target has " + std::to_string(input.target.size()) +
                         " points, a fit needs at least " + std::to_string(kMinPoints));
  }
  for (const PointConstraint& landmark : input.landmarks) {
    Status status = CheckIndex("a landmark", landmark.point, input.source.size());
    if (!status.ok()) return status;
  }
  for (const int point : input.fixed_points) {
    Status status = CheckIndex("the list of fixed points", point, input.source.size());
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

Status CheckScale(const FitInput& input, const FitOptions& options) {
  const double source = Diagonal(input.source.points);
  if (!(source > 0.0)) return Status::Error("the source has no extent: all its points coincide");
  if (input.target.empty()) return Status::Ok();
  const double target = Diagonal(input.target.points);
  if (!(target > 0.0)) return Status::Error("the target has no extent: all its points coincide");
  const double ratio = std::max(source / target, target / source);
  if (ratio <= kMaxScaleRatio || options.rigid.with_scale) return Status::Ok();
  std::ostringstream message;
  message << "source and target share no scale: their diagonals are " << source << " and " << target
          << " (at most a factor of " << kMaxScaleRatio << " is expected; are the units the same?)";
  return Status::Error(message.str());
}

// The pose that landmarks ask for; the given one where they don't determine it.
Similarity PoseFromLandmarks(const FitInput& input, bool with_scale) {
  std::vector<Eigen::Vector3d> from;
  std::vector<Eigen::Vector3d> to;
  for (const PointConstraint& landmark : input.landmarks) {
    from.push_back(input.source.points[landmark.point]);
    to.push_back(landmark.position);
  }
  const StatusOr<Similarity> pose = Similarity::FitPoints(from, to, with_scale);
  return pose.ok() ? *pose : Similarity();
}

PointCloud Transformed(const Similarity& pose, const PointCloud& cloud) {
  PointCloud moved = cloud;
  for (Eigen::Vector3d& point : moved.points) point = pose * point;
  for (Eigen::Vector3d& normal : moved.normals) normal = pose.rotation * normal;
  return moved;
}

// unit_from_target: the frame of the solve, where the rigidly placed source has diagonal 1.
Similarity UnitFrame(const PointCloud& placed_source) {
  const Eigen::AlignedBox3d box = BoundingBox(placed_source.points);
  Similarity unit_from_target;
  unit_from_target.scale = 1.0 / box.diagonal().norm();
  unit_from_target.translation = -unit_from_target.scale * box.center();
  return unit_from_target;
}

// A graph and state of the unit frame, in the source frame: with M = unit_from_source,
// g = M^-1 g', A = R^T A' R and t = (s R)^-1 t', which leaves E_rot as it is.
Warp WarpInSourceFrame(const BuiltGraph& graph,
                       const DeformationState& state,
                       const std::vector<Eigen::Vector3d>& source_points,
                       const Similarity& unit_from_source,
                       const Similarity& target_from_source) {
  Warp warp;
  warp.target_from_source = target_from_source;
  warp.binding = graph.binding;
  const Eigen::Matrix3d R = unit_from_source.rotation.toRotationMatrix();
  for (int j = 0; j < graph.graph.num_nodes(); ++j) {
    warp.graph.AddNode(source_points[graph.node_points[j]]);
  }
  for (const GraphEdge& edge : graph.graph.edges()) warp.graph.AddEdge(edge);
  warp.state.Resize(graph.graph.num_nodes());
  for (int j = 0; j < graph.graph.num_nodes(); ++j) {
    MutableNodeAffine(warp.state.node(j)) = R.transpose() * NodeAffine(state.node(j)) * R;
    MutableNodeTranslation(warp.state.node(j)) =
        R.transpose() * NodeTranslation(state.node(j)) / unit_from_source.scale;
  }
  return warp;
}

// The state of other nodes, at some of the source's points, under the warp of `graph`.
DeformationState CarryOver(const BuiltGraph& graph,
                           const DeformationState& state,
                           const std::vector<int>& node_points,
                           const std::vector<Eigen::Vector3d>& points) {
  DeformationState carried(static_cast<int>(node_points.size()));
  for (int j = 0; j < carried.num_nodes(); ++j) {
    const int point = node_points[j];
    const Binding binding = graph.skinning[point];
    MutableNodeAffine(carried.node(j)) = WarpGradient(state, binding);
    MutableNodeTranslation(carried.node(j)) =
        WarpPoint(graph.graph, state, binding, points[point]) - points[point];
  }
  return carried;
}

std::vector<Correspondence> InUnitFrame(const std::vector<PointConstraint>& constraints,
                                        const Similarity& unit_from_target) {
  std::vector<Correspondence> correspondences;
  for (const PointConstraint& constraint : constraints) {
    Correspondence correspondence;
    correspondence.point = constraint.point;
    correspondence.target = unit_from_target * constraint.position;
    correspondences.push_back(correspondence);
  }
  return correspondences;
}

// One fit: the steps of Fit() and what they share.
class Fitter {
 public:
  Fitter(const FitInput& input, const FitOptions& options, const EnergyRegistry& registry)
      : input_(input), options_(options), registry_(registry) {}

  StatusOr<FitResult> Run();

 private:
  void PlaceRigidly();
  // The graph of one level; `coarsening` multiplies the node spacing of the last one.
  StatusOr<BuiltGraph> BuildUnitGraph(const Surface& source,
                                      const BuiltGraph* finest,
                                      double coarsening) const;
  Status RunLevels(const Surface& source, const Surface* target);
  FitOptions UnitOptions(const Surface& source, const Surface* target) const;
  void Finish(const BuiltGraph& graph, const DeformationState& state);
  void WarnAboutReflections(const DeformationState& state);

  const FitInput& input_;
  const FitOptions& options_;
  const EnergyRegistry& registry_;
  const Timer clock_;
  Similarity unit_from_target_;
  FitResult result_;
};

void Fitter::PlaceRigidly() {
  const Timer timer;
  if (!options_.rigid_first || !input_.fixed_points.empty()) return;
  result_.rigid = PoseFromLandmarks(input_, options_.rigid.with_scale);
  if (!input_.target.empty()) {
    RigidOptions rigid = options_.rigid;
    rigid.num_threads = options_.num_threads;
    rigid.should_stop = [this] {
      return (options_.should_stop && options_.should_stop()) ||
             clock_.Seconds() >= options_.time_limit_s;
    };
    const Surface source(input_.source, options_.num_threads);
    const Surface target(input_.target, options_.num_threads);
    result_.rigid = AlignRigid(source, target, result_.rigid, rigid).target_from_source;
  }
  result_.times.rigid = timer.Seconds();
}

StatusOr<BuiltGraph> Fitter::BuildUnitGraph(const Surface& source,
                                            const BuiltGraph* finest,
                                            double coarsening) const {
  GraphOptions graph_options = options_.graph;
  graph_options.node_spacing *= unit_from_target_.scale * result_.rigid.scale;
  graph_options.num_threads = options_.num_threads;
  if (finest != nullptr) {
    graph_options.node_spacing = finest->node_spacing * coarsening;
    graph_options.target_nodes = 0;
  }
  return BuildGraph(source.cloud(), source.topology(), graph_options);
}

FitOptions Fitter::UnitOptions(const Surface& source, const Surface* target) const {
  FitOptions options = options_;
  options.matching.max_distance *= unit_from_target_.scale;
  options.matching.num_threads = options_.num_threads;
  if (target != nullptr) {
    // What lies between two samples can't be told apart; bare points have no edges to go by.
    const double edge =
        std::min(MeanEdgeLength(source.topology()), MeanEdgeLength(target->topology()));
    options.matching.resolution = std::max(0.1 * edge, 1e-4);
  }
  return options;
}

void Fitter::Finish(const BuiltGraph& graph, const DeformationState& state) {
  result_.warp = WarpInSourceFrame(
      graph, state, input_.source.points, unit_from_target_ * result_.rigid, result_.rigid);
  result_.skinning = graph.skinning;
  PointCloud fitted = input_.source;
  const Status applied = ApplyWarp(result_.warp, result_.skinning, &fitted, options_.num_threads);
  CHECK(applied.ok()) << applied.message();
  result_.points = std::move(fitted.points);
  result_.normals = std::move(fitted.normals);
  const auto finite = [](const Eigen::Vector3d& point) { return point.allFinite(); };
  if (!std::all_of(result_.points.begin(), result_.points.end(), finite)) {
    result_.status = SolveStatus::kFailed;
    result_.message = "the warped source isn't finite";
  }
  for (const int point : input_.fixed_points) {
    result_.max_fixed_error = std::max(
        result_.max_fixed_error, (result_.points[point] - input_.source.points[point]).norm());
  }
  WarnAboutReflections(state);
  result_.matches.rms_plane /= unit_from_target_.scale;
  result_.matches.rms_point /= unit_from_target_.scale;
  result_.matches.robust_distance /= unit_from_target_.scale;
}

void Fitter::WarnAboutReflections(const DeformationState& state) {
  int reflected = 0;
  for (int j = 0; j < state.num_nodes(); ++j) {
    if (!(NodeAffine(state.node(j)).determinant() > 0.0)) ++reflected;
  }
  if (reflected == 0) return;
  result_.warnings.push_back(std::to_string(reflected) + " of " +
                             std::to_string(state.num_nodes()) +
                             " nodes turned inside out (det A <= 0): the surface is folded there");
}

StatusOr<FitResult> Fitter::Run() {
  std::string error;
  if (!options_.IsValid(&error)) return Status::Error(error);
  if (Status status = CheckInput(input_); !status.ok()) return status;
  if (Status status = CheckScale(input_, options_); !status.ok()) return status;
  PlaceRigidly();

  Timer timer;
  PointCloud placed = Transformed(result_.rigid, input_.source);
  unit_from_target_ = UnitFrame(placed);
  const Surface source(Transformed(unit_from_target_, placed), options_.num_threads);
  std::unique_ptr<Surface> target;
  if (!input_.target.empty()) {
    target = std::make_unique<Surface>(Transformed(unit_from_target_, input_.target),
                                       options_.num_threads);
  }
  result_.times.prepare = timer.Seconds();
  if (Status status = RunLevels(source, target.get()); !status.ok()) return status;
  return std::move(result_);
}

// Fits with few nodes first, carries the warp over to more, and goes on.
Status Fitter::RunLevels(const Surface& source, const Surface* target) {
  Timer timer;
  StatusOr<BuiltGraph> finest = BuildUnitGraph(source, nullptr, 1.0);
  if (!finest.ok()) return finest.status();
  result_.warnings.insert(result_.warnings.end(), finest->warnings.begin(), finest->warnings.end());
  result_.times.graph = timer.Seconds();
  std::vector<PointConstraint> fixed;
  for (const int point : input_.fixed_points) fixed.push_back({point, input_.source.points[point]});
  const FitOptions unit_options = UnitOptions(source, target);
  const std::vector<LevelPlan> plans = PlanLevels(options_);

  BuiltGraph graph;
  DeformationState state;
  for (std::size_t level = 0; level < plans.size(); ++level) {
    timer.Restart();
    const bool last = level + 1 == plans.size();
    StatusOr<BuiltGraph> next =
        last ? std::move(finest)
             : BuildUnitGraph(source, &*finest, std::pow(2.0, plans.size() - 1 - level));
    // A body of few nodes has no coarser graph: the finer levels do all of it.
    if (!next.ok()) continue;
    state = graph.graph.num_nodes() == 0
                ? DeformationState(next->graph.num_nodes())
                : CarryOver(graph, state, next->node_points, source.cloud().points);
    graph = *std::move(next);
    result_.times.graph += timer.Seconds();
    FitProblem problem(graph, source.cloud().points);
    Status status = problem.AddEnergies(unit_options,
                                        registry_,
                                        InUnitFrame(input_.landmarks, unit_from_target_),
                                        InUnitFrame(fixed, unit_from_target_));
    if (!status.ok()) return status;
    RunNonrigidLoop(
        source, target, graph, unit_options, plans[level], clock_, &problem, &state, &result_);
    if (result_.status != SolveStatus::kConverged &&
        result_.status != SolveStatus::kMaxIterations) {
      break;
    }
  }
  Finish(graph, state);
  return Status::Ok();
}

}  // namespace

bool FitOptions::IsValid(std::string* error) const {
  if (!strategy.IsValid(error) || !graph.IsValid(error) || !matching.IsValid(error) ||
      !rigid.IsValid(error)) {
    return false;
  }
  std::ostringstream message;
  const auto bad = [&](const char* name, double value, const char* expected) {
    message << name << " is " << value << ", expected " << expected;
  };
  const double all_weights[] = {
      weights.rotation, weights.regularization, weights.data, weights.landmark, weights.fixed};
  for (const double weight : all_weights) {
    if (!(std::isfinite(weight) && weight >= 0.0)) {
      bad("a weight", weight, "finite and >= 0");
      break;
    }
  }
  if (!message.str().empty()) {
  } else if (!(weights.point_to_point_share >= 0.0 && weights.point_to_point_share <= 1.0)) {
    bad("point_to_point_share", weights.point_to_point_share, "in [0, 1]");
  } else if (!(schedule.initial_stiffness >= 1.0)) {
    bad("initial_stiffness", schedule.initial_stiffness, ">= 1");
  } else if (schedule.levels < 1 || schedule.levels > kMaxLevels) {
    bad("levels", schedule.levels, "in [1, 5]");
  } else if (std::min({schedule.coarse_steps,
                       schedule.fine_steps,
                       schedule.max_rounds,
                       schedule.solver_iterations}) < 1) {
    message << "coarse_steps, fine_steps, max_rounds and solver_iterations are expected >= 1";
  } else if (!(schedule.tolerance > 0.0)) {
    bad("tolerance", schedule.tolerance, "> 0");
  } else if (!(std::min(loss_width, coarse_loss_width) > 0.0)) {
    bad("loss_width or coarse_loss_width", std::min(loss_width, coarse_loss_width), "> 0");
  } else if (max_samples < 10) {
    bad("max_samples", max_samples, ">= 10");
  } else if (num_threads < 1) {
    bad("num_threads", num_threads, ">= 1");
  } else if (!(time_limit_s > 0.0)) {
    bad("time_limit_s", time_limit_s, "> 0 seconds");
  }
  *error = message.str();
  return error->empty();
}

StatusOr<FitResult> Fit(const FitInput& input,
                        const FitOptions& options,
                        const EnergyRegistry& registry) {
  return Fitter(input, options, registry).Run();
}

StatusOr<FitResult> Fit(const PointCloud& source, const PointCloud& target) {
  FitInput input;
  input.source = source;
  input.target = target;
  EnergyRegistry registry;
  RegisterBuiltinEnergies(&registry);
  return Fit(input, {}, registry);
}

}  // namespace ceres_ed
