#include "ceres_ed/registration/coarse_to_fine.h"

#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/edges.h>
#include <ceres_ed/registration/evidence/way_agreement.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/hypotheses/explanation.h>
#include <ceres_ed/registration/intrinsic/intrinsic_start.h>
#include <ceres_ed/registration/uncertainty/fit_uncertainty.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

namespace ceres_ed {
namespace {

// The distance at which a point counts half as unmatched, as a fraction of the source's diagonal,
// while ways are compared on a coarse graph, which cannot follow details, and on the finest one.
constexpr double kUnmatchedWidth = 0.02;
constexpr double kFineWidth = 0.0025;
// Noise leaves residuals of this many standard deviations.
constexpr double kResidualPerNoise = 2.0;
// So many attempts are followed on the finest graph if they are this near to the best one, and if
// that one leaves more than a small share unmatched.
constexpr std::size_t kFinalists = 2;
constexpr double kFinalistMargin = 0.1;
// Nodes that two warps move to places this near in the mean make the two the same.
constexpr double kSameWarp = 0.01;
// A coarse graph leaves this share unmatched at most where it has followed all of the smaller
// surface; this is worth so much beyond the share itself, and there are no other finalists.
constexpr double kExplained = 0.03;
constexpr double kExplainedBonus = 0.02;
// If more than this share of the other surface is unmatched, one shows only a part of the other.
constexpr double kPartial = 0.2;
// An attempt falls behind if, in one of so many steps before the last one, it is not to be expected
// any more that it reaches the best one: a step gains at most about these shares.
constexpr int kForeseenSteps = 2;
constexpr double kGainAtLeast = 0.05;
constexpr double kGainPerStep = 0.05;
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
// Returns the mean distance between the places to which two states move the nodes.
double MeanDistance(const DeformationState& a, const DeformationState& b) {
  double sum = 0.0;
  for (int j = 0; j < a.num_nodes(); ++j) {
    sum += (NodeTranslation(a.node(j)) - NodeTranslation(b.node(j))).norm();
  }
  return a.num_nodes() > 0 ? sum / a.num_nodes() : 0.0;
}

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
  // How the points are connected does not matter to so few nodes, and takes longest to find.
  PointCloud points;
  points.points = source.cloud().points;
  return BuildGraph(points, options);
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
  // Nodes inside belong to no piece.
  piece.resize(built->graph.num_nodes(), static_cast<int>(is_carried.size()));
  is_carried.push_back(0);
  CarryPieces(
      piece, is_carried, kCarryingEdges, kCarryingReach * built->node_spacing, &built->graph);
}

}  // namespace

Status CoarseToFine::BuildGraphs(int resolutions, FitResult* result) {
  const Timer timer;
  const Surface& source = *fit_.source;
  GraphOptions fine = fit_.options->graph;
  fine.should_stop = [this, result] { return MustEnd(fit_, result); };
  StatusOr<BuiltGraph> finest = MustEnd(fit_, result)
                                    ? GraphForNoTime(source)
                                    : BuildGraph(source.cloud(), source.topology(), fine);
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
  const BuiltGraph& next = graphs_[resolution];
  const std::vector<Eigen::Vector3d>& points = fit_.source->cloud().points;
  DeformationState carried(next.graph.num_nodes());
  const auto carry = [&](int node, const Binding& binding, const Eigen::Vector3d& point) {
    MutableNodeAffine(carried.node(node)) = WarpGradient(state, binding);
    MutableNodeTranslation(carried.node(node)) =
        WarpPoint(graph.graph, state, binding, point) - point;
  };
  const int num_surface_nodes = next.graph.num_surface_nodes();
  for (int j = 0; j < num_surface_nodes; ++j) {
    carry(j, graph.skinning[next.node_points[j]], points[next.node_points[j]]);
  }
  std::vector<Eigen::Vector3d> inner;
  for (int j = num_surface_nodes; j < carried.num_nodes(); ++j) {
    inner.push_back(next.graph.position(j));
  }
  const Skinning skinning = BindInBody(inner, graph.graph, graph.binding.num_threads);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    carry(num_surface_nodes + static_cast<int>(i), skinning[i], inner[i]);
  }
  return carried;
}

Status CoarseToFine::RunResolution(int resolution,
                                   const ResolutionPlan& plan,
                                   DeformationState* state,
                                   FitResult* result) const {
  const BuiltGraph& graph = graphs_[resolution];
  FitProblem problem(graph, fit_.source->cloud(), plan.is_last);
  Status status = problem.AddEnergies(*fit_.options, *fit_.registry, fit_.landmarks, fit_.fixed);
  if (!status.ok()) return status;
  RunNonrigidLoop(fit_, graph, plan, &problem, state, result);
  if (fit_.options->covariance && plan.is_last && !EndedEarly(*result)) {
    MeasureUncertainty(fit_, graph, *state, &problem, result);
  }
  return Status::Ok();
}

Status CoarseToFine::FollowCoarse(double best, Attempt* attempt, FitResult* result) const {
  const int last = LastGraph();
  for (int resolution = 0; resolution < last; ++resolution) {
    if (resolution > 0) {
      attempt->state = CarryOver(graphs_[resolution - 1], attempt->state, resolution);
    }
    attempt->graph = resolution;
    ResolutionPlan plan = attempt->hypothesis.Apply(plans_[resolution], /*is_finest=*/false);
    plan.progress_begin *= attempt->progress;
    plan.progress_end *= attempt->progress;
    plan.unmatched_width = kUnmatchedWidth;
    bool has_fallen_behind = false;
    const int steps = plan.steps;
    plan.keep_going = [&](int step, const Unmatched& unmatched) {
      const int remaining = steps - 1 - step;
      const double gain = kGainAtLeast + kGainPerStep * remaining;
      has_fallen_behind = remaining <= kForeseenSteps && MeanAmongWays(unmatched) - gain > best;
      return !has_fallen_behind;
    };
    Status status = RunResolution(resolution, plan, &attempt->state, result);
    if (!status.ok()) return status;
    if (EndedEarly(*result)) break;
    if (has_fallen_behind) return Status::Ok();
  }
  attempt->is_whole = true;
  const Explanation left =
      MeasureExplanation(fit_, graphs_[attempt->graph], attempt->state, kUnmatchedWidth);
  // What noise leaves unmatched by itself.
  const double by_noise = std::pow(kResidualPerNoise * fit_.noise / kUnmatchedWidth, 2);
  const auto [better, worse] = std::minmax(left.unmatched.source, left.unmatched.target);
  attempt->unmatched = better - by_noise;
  attempt->worse = worse - by_noise + left.lost_area;
  attempt->is_explained = attempt->unmatched < kExplained;
  attempt->is_partial = worse > kPartial;
  attempt->left = left.AmongWays() + attempt->hypothesis.handicap -
                  (attempt->is_explained ? kExplainedBonus : 0.0);
  return Status::Ok();
}

std::vector<DeformationState> CoarseToFine::StartsOf(const Hypothesis& hypothesis) const {
  if (hypothesis.start == HypothesisStart::kIntrinsic) return IntrinsicStarts(fit_, graphs_[0]);
  return {StartOf(hypothesis, fit_, graphs_[0])};
}

Status CoarseToFine::TryHypotheses(std::vector<Attempt>* attempts, FitResult* result) const {
  const std::vector<Hypothesis> hypotheses = ListHypotheses(fit_);
  double unmatched = std::numeric_limits<double>::infinity();
  double worse = unmatched;
  double best = unmatched;
  bool is_partial = true;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    const Hypothesis& hypothesis = hypotheses[i];
    const bool is_needed = unmatched >= hypothesis.needed_above ||
                           (is_partial && hypothesis.needed_if_partial) ||
                           worse >= hypothesis.needed_above_worse;
    if (!is_needed) continue;
    for (DeformationState& start : StartsOf(hypothesis)) {
      Attempt attempt;
      attempt.hypothesis = hypothesis;
      attempt.state = std::move(start);
      attempt.progress = static_cast<double>(i + 1) / static_cast<double>(hypotheses.size());
      if (Status status = FollowCoarse(best, &attempt, result); !status.ok()) return status;
      if (attempt.is_whole) {
        unmatched = std::min(unmatched, attempt.unmatched);
        worse = std::min(worse, attempt.worse);
        best = std::min(best, attempt.left);
        is_partial = is_partial && attempt.is_partial;
        attempts->push_back(std::move(attempt));
      }
      if (EndedEarly(*result)) break;
    }
    if (EndedEarly(*result)) break;
  }
  if (attempts->empty()) {
    // There was no intrinsic start, and no other way was chosen: the source stays where it is.
    Attempt rest;
    rest.hypothesis = hypotheses.front();
    rest.state = DeformationState(graphs_[0].graph.num_nodes());
    attempts->push_back(std::move(rest));
  }
  std::stable_sort(attempts->begin(), attempts->end(), [](const Attempt& a, const Attempt& b) {
    return a.left < b.left;
  });
  // The best careful way and the best bold one are compared.
  WayAgreement ways;
  std::set<double> widths;
  for (const Attempt& attempt : *attempts) {
    if (!widths.insert(attempt.hypothesis.loss_width).second) continue;
    ways.Add(*fit_.source, graphs_[attempt.graph], attempt.state, attempt.left);
  }
  result->evidence.disagreement = ways.Disagreement();
  return Status::Ok();
}

void CoarseToFine::KeepFinalists(std::vector<Attempt>* attempts) const {
  std::vector<Attempt> finalists;
  for (Attempt& attempt : *attempts) {
    const bool is_near = finalists.empty() || attempt.left < finalists[0].left + kFinalistMargin;
    const bool is_new =
        std::none_of(finalists.begin(), finalists.end(), [&](const Attempt& finalist) {
          return attempt.graph == finalist.graph &&
                 MeanDistance(attempt.state, finalist.state) < kSameWarp;
        });
    if (is_near && is_new) finalists.push_back(std::move(attempt));
    if (finalists.size() == kFinalists || finalists[0].is_explained) break;
  }
  *attempts = std::move(finalists);
}

void CoarseToFine::Take(Attempt attempt, FitResult* result) {
  graph_ = attempt.graph;
  state_ = std::move(attempt.state);
  result->hypothesis = attempt.hypothesis.name;
}

Status CoarseToFine::FollowFine(std::vector<Attempt> attempts, FitResult* result) {
  const int last = LastGraph();
  FitResult best_result;
  const double width = std::max(kFineWidth, kCheckWidthPerNoise * fit_.noise);
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    Attempt& attempt = attempts[i];
    FitResult trial = *result;
    attempt.state = CarryOver(graphs_[attempt.graph], attempt.state, last);
    attempt.graph = last;
    const ResolutionPlan plan = attempt.hypothesis.Apply(plans_[last], /*is_finest=*/true);
    Status status = RunResolution(last, plan, &attempt.state, &trial);
    if (!status.ok()) return status;
    if (attempts.size() > 1) {
      attempt.left = MeasureExplanation(fit_, graphs_[last], attempt.state, width).AmongWays() +
                     attempt.hypothesis.handicap;
    }
    // What the trials have cost is counted, whichever is taken.
    result->times = trial.times;
    result->outer_iterations = trial.outer_iterations;
    result->solver_iterations = trial.solver_iterations;
    const bool is_stopped = EndedEarly(trial);
    if (i == 0 || (!is_stopped && attempt.left < attempts[0].left)) {
      best_result = std::move(trial);
      if (i > 0) std::swap(attempts[0], attempts[i]);
    }
    if (is_stopped) break;
  }
  best_result.times = result->times;
  best_result.outer_iterations = result->outer_iterations;
  best_result.solver_iterations = result->solver_iterations;
  *result = std::move(best_result);
  Take(std::move(attempts[0]), result);
  return Status::Ok();
}

Status CoarseToFine::Run(FitResult* result) {
  if (Status status = BuildGraphs(fit_.options->schedule.levels, result); !status.ok()) {
    return status;
  }
  plans_ = PlanResolutions(fit_, static_cast<int>(graphs_.size()));
  const int last = LastGraph();
  graph_ = last;
  state_ = DeformationState(graphs_[last].graph.num_nodes());
  if (MustEnd(fit_, result)) return Status::Ok();
  if (last == 0) {
    Status status = RunResolution(last, plans_[last], &state_, result);
    if (status.ok()) KeepTheBetter(result);
    return status;
  }
  std::vector<Attempt> attempts;
  if (Status status = TryHypotheses(&attempts, result); !status.ok()) return status;
  if (EndedEarly(*result)) {
    Take(std::move(attempts[0]), result);
    return Status::Ok();
  }
  KeepFinalists(&attempts);
  Status status = FollowFine(std::move(attempts), result);
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
