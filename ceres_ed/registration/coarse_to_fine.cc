#include "ceres_ed/registration/coarse_to_fine.h"

#include <ceres_ed/graph/edges.h>
#include <ceres_ed/registration/evidence/way_agreement.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/fit_uncertainty.h>
#include <ceres_ed/registration/hypotheses/explanation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace ceres_ed {
namespace {

// The distance at which a point counts half as unmatched, as a fraction of the source's diagonal,
// and the share below which nothing counts as unmatched.
constexpr double kUnmatchedWidth = 0.02;
constexpr double kNothingUnmatched = 0.01;
// The same distance for the check against the rigid placement, which compares two states of which
// both may be near the target: it is smaller, but not below a multiple of the noise.
constexpr double kCheckWidth = 0.005;
constexpr double kCheckWidthPerNoise = 3.0;
// Shares that differ by less than this are equal: rounding and the meshing decide about the rest.
constexpr double kSameShare = 1e-4;
// A deformation with energies of the user may leave this times as much unexplained as the rigid
// placement, and this share more.
constexpr double kOwnEnergyFactor = 1.1;
constexpr double kOwnEnergyMargin = 0.02;
// A node of a piece without landmarks follows this many nodes of other pieces within this many node
// spacings.
constexpr int kCarryingEdges = 12;
constexpr double kCarryingReach = 1.5;
bool EndedEarly(const FitResult& result) {
  return result.status != SolveStatus::kConverged && result.status != SolveStatus::kMaxIterations;
}

// Returns whether the fit was stopped, as opposed to failed.
bool EndedEarlyBy(const FitResult& result) {
  return result.status == SolveStatus::kInterrupted || result.status == SolveStatus::kTimeLimit;
}

// Returns a graph of a few nodes that takes no time to build: the warp of a fit that was stopped
// before its graph was there. Its points do not move.
StatusOr<BuiltGraph> GraphForNoTime(const Surface& source) {
  GraphOptions options;
  options.distance = DistanceRule::kEuclidean;
  options.auto_spacing = 0.3;
  return BuildGraph(source.cloud(), source.topology(), options);
}

// Links the pieces of the source that have no landmark to the pieces near them: landmarks on some
// pieces carry the pieces between them.
void CarryPiecesWithoutLandmarks(const UnitFit& fit, BuiltGraph* built) {
  const SurfaceTopology& topology = fit.source->topology();
  if (fit.landmarks.empty() || built->binding.distance != DistanceRule::kSurface) return;
  std::vector<char> is_carried(topology.num_components(), 1);
  for (const auto* held : {&fit.landmarks, &fit.fixed}) {
    for (const Correspondence& point : *held) is_carried[topology.component[point.point]] = 0;
  }
  std::vector<int> piece;
  for (const int point : built->node_points) piece.push_back(topology.component[point]);
  CarryPieces(
      piece, is_carried, kCarryingEdges, kCarryingReach * built->node_spacing, &built->graph);
}

}  // namespace

Status CoarseToFine::BuildGraphs(int resolutions, FitResult* result) {
  const Timer timer;
  const Surface& source = *fit_.source;
  GraphOptions fine = fit_.options->graph;
  fine.should_stop = [this, result] { return MustEnd(fit_, result); };
  StatusOr<BuiltGraph> finest = BuildGraph(source.cloud(), source.topology(), fine);
  if (!finest.ok() && EndedEarlyBy(*result)) finest = GraphForNoTime(source);
  if (!finest.ok()) return finest.status();
  result->warnings.insert(result->warnings.end(), finest->warnings.begin(), finest->warnings.end());
  for (int resolution = resolutions - 1; resolution > 0; --resolution) {
    if (MustEnd(fit_, result)) break;
    GraphOptions options = fine;
    options.node_spacing = finest->node_spacing * std::pow(2.0, resolution);
    options.target_nodes = 0;
    StatusOr<BuiltGraph> coarse = BuildGraph(source.cloud(), source.topology(), options);
    // A body with few nodes has no coarser graph; the finer resolutions then do all the work.
    if (coarse.ok()) graphs_.push_back(*std::move(coarse));
  }
  graphs_.push_back(*std::move(finest));
  for (BuiltGraph& graph : graphs_) CarryPiecesWithoutLandmarks(fit_, &graph);
  result->times.graph = timer.Seconds();
  return Status::Ok();
}

DeformationState CoarseToFine::CarryOver(const BuiltGraph& graph,
                                         const DeformationState& state,
                                         int resolution) const {
  const std::vector<int>& node_points = graphs_[resolution].node_points;
  const std::vector<Eigen::Vector3d>& points = fit_.source->cloud().points;
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

Status CoarseToFine::RunResolution(int resolution,
                                   const ResolutionPlan& plan,
                                   DeformationState* state,
                                   FitResult* result) const {
  const BuiltGraph& graph = graphs_[resolution];
  FitProblem problem(graph, fit_.source->cloud());
  Status status = problem.AddEnergies(*fit_.options, *fit_.registry, fit_.landmarks, fit_.fixed);
  if (!status.ok()) return status;
  RunNonrigidLoop(fit_, graph, plan, &problem, state, result);
  if (fit_.options->covariance) {
    if (EndedEarly(*result)) {
      DropUncertainty("the fit ended early", result);
    } else if (plan.is_last) {
      MeasureUncertainty(fit_, graph, problem, *state, result);
    }
  }
  return Status::Ok();
}

Status CoarseToFine::FollowCoarse(const Hypothesis& hypothesis,
                                  const std::vector<ResolutionPlan>& plans,
                                  DeformationState* state,
                                  int* reached,
                                  FitResult* result) const {
  const int last = static_cast<int>(graphs_.size()) - 1;
  *state = StartOf(hypothesis, fit_, graphs_[0]);
  for (int resolution = 0; resolution < last; ++resolution) {
    ResolutionPlan plan = plans[resolution];
    plan.loss_width = hypothesis.loss_width;
    plan.max_angle_deg = hypothesis.max_angle_deg;
    plan.max_distance = hypothesis.max_distance;
    plan.first_stiffness *= hypothesis.stiffness;
    plan.last_stiffness *= hypothesis.stiffness;
    if (resolution > 0) {
      *state = CarryOver(graphs_[resolution - 1], *state, resolution);
    }
    *reached = resolution;
    if (Status status = RunResolution(resolution, plan, state, result); !status.ok()) return status;
    if (EndedEarly(*result)) break;
  }
  return Status::Ok();
}

Status CoarseToFine::ChooseHypothesis(const std::vector<ResolutionPlan>& plans,
                                      double* loss_width,
                                      FitResult* result) {
  double best = std::numeric_limits<double>::infinity();
  WayAgreement ways;
  for (const Hypothesis& hypothesis : ListHypotheses(fit_)) {
    DeformationState state;
    int reached = 0;
    if (Status status = FollowCoarse(hypothesis, plans, &state, &reached, result); !status.ok()) {
      return status;
    }
    const Explanation left = MeasureExplanation(fit_, graphs_[reached], state, kUnmatchedWidth);
    ways.Add(*fit_.source, graphs_[reached], state, left.AmongWays());
    if (left.AmongWays() < best) {
      best = left.AmongWays();
      *loss_width = hypothesis.loss_width;
      result->hypothesis = hypothesis.name;
      graph_ = reached;
      state_ = std::move(state);
    }
    if (EndedEarly(*result)) break;
    // Everything that the smaller surface shows is explained, so another way cannot be better.
    if (std::min(left.unmatched.source, left.unmatched.target) < kNothingUnmatched) break;
  }
  result->evidence.disagreement = ways.Disagreement();
  return Status::Ok();
}

Status CoarseToFine::Run(FitResult* result) {
  if (Status status = BuildGraphs(fit_.options->schedule.levels, result); !status.ok()) {
    return status;
  }
  const std::vector<ResolutionPlan> plans = PlanResolutions(fit_, static_cast<int>(graphs_.size()));
  const int last = static_cast<int>(graphs_.size()) - 1;
  if (MustEnd(fit_, result)) {
    graph_ = last;
    state_ = DeformationState(graphs_[last].graph.num_nodes());
    return Status::Ok();
  }
  // The coarse graphs are fitted in each way; the finest one starts from the best coarse state.
  ResolutionPlan plan = plans[last];
  plan.loss_width = fit_.options->loss_width;
  if (last > 0) {
    Status status = ChooseHypothesis(plans, &plan.loss_width, result);
    if (!status.ok() || EndedEarly(*result)) return status;
    state_ = CarryOver(graphs_[graph_], state_, last);
  } else {
    state_ = DeformationState(graphs_[last].graph.num_nodes());
  }
  graph_ = last;
  Status status = RunResolution(last, plan, &state_, result);
  if (status.ok()) KeepTheBetter(result);
  return status;
}

// Landmarks and fixed points are given by the user and are kept, whatever they do to the surfaces.
void CoarseToFine::KeepTheBetter(FitResult* result) {
  if (fit_.target == nullptr || !fit_.landmarks.empty() || !fit_.fixed.empty()) return;
  const DeformationState rest(graphs_[graph_].graph.num_nodes());
  const double width = std::max(kCheckWidth, kCheckWidthPerNoise * fit_.noise);
  const auto measure = [&](const DeformationState& state) {
    return MeasureExplanation(fit_, graphs_[graph_], state, width).AgainstRigid();
  };
  const double rigid = measure(rest);
  const double fitted = measure(state_);
  const bool has_own_energies = !fit_.options->extra_energies.empty();
  if (fitted <=
      (has_own_energies ? kOwnEnergyFactor * rigid + kOwnEnergyMargin : rigid + kSameShare)) {
    return;
  }
  std::ostringstream message;
  message << "the deformation leaves more of the surfaces unexplained (" << 100.0 * fitted
          << " %) than the rigid placement (" << 100.0 * rigid
          << " %): the result is the rigid one; are these two states of one body?";
  result->warnings.push_back(message.str());
  result->rigid_only = true;
  if (fit_.options->covariance) DropUncertainty("the deformation was left out", result);
  state_ = rest;
  result->final_energy = result->initial_energy;
}

}  // namespace ceres_ed
