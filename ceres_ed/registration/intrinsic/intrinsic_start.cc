#include "ceres_ed/registration/intrinsic/intrinsic_start.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/fit_problem.h>
#include <ceres_ed/registration/intrinsic/intrinsic_match.h>
#include <ceres_ed/registration/rigid_motion.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

// The factors of E_rot and E_reg in the steps of the solution.
constexpr double kStiffness[] = {100.0, 30.0, 10.0, 3.0};
constexpr int kIterations = 3;
// The weight of the matches, relative to E_rot and E_reg.
constexpr double kMatchWeight = 1.0;
// The width of the Welsch weights in robust standard deviations.
constexpr double kWidth = 3.0;
constexpr double kLeastWidth = 1e-6;
// So many states go on; the others have at most this times the misfit of the best one.
constexpr std::size_t kMostStarts = 2;
constexpr double kSimilar = 1.2;

// Returns the distances in `state` between the points of `matches` and their places.
std::vector<double> Distances(const UnitFit& fit,
                              const BuiltGraph& graph,
                              const DeformationState& state,
                              const std::vector<Correspondence>& matches) {
  std::vector<double> distances;
  distances.reserve(matches.size());
  for (const Correspondence& match : matches) {
    const Eigen::Vector3d& point = fit.source->cloud().points[match.point];
    const Eigen::Vector3d moved = WarpPoint(graph.graph, state, graph.skinning[match.point], point);
    distances.push_back((moved - match.target).norm());
  }
  return distances;
}

double WeightedMean(const std::vector<double>& values, const std::vector<Correspondence>& matches) {
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += matches[i].weight * values[i];
    weight += matches[i].weight;
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

}  // namespace

StatusOr<FollowedMatches> FollowMatches(const UnitFit& fit,
                                        const BuiltGraph& graph,
                                        std::vector<Correspondence> matches) {
  FollowedMatches followed;
  followed.state = RigidMotion(fit, graph, matches);
  FitOptions options = *fit.options;
  options.weights.data = 0.0;
  options.weights.landmark = kMatchWeight;
  options.extra_energies.clear();
  const std::vector<Correspondence> given = matches;
  SolverOptions solver;
  solver.max_iterations = kIterations;
  solver.num_threads = options.num_threads;
  solver.should_stop = options.should_stop;
  std::vector<double> distances = Distances(fit, graph, followed.state, given);
  for (const double stiffness : kStiffness) {
    const double width = std::max(kWidth * kDeviationPerMedian * Median(distances), kLeastWidth);
    for (std::size_t i = 0; i < given.size(); ++i) {
      const double ratio = distances[i] / width;
      matches[i].weight = given[i].weight * std::exp(-ratio * ratio);
    }
    FitProblem problem(graph, fit.source->cloud(), /*is_last=*/false);
    Status status = problem.AddEnergies(options, *fit.registry, matches, fit.fixed);
    if (!status.ok()) return status;
    problem.SetStiffness(stiffness);
    const std::unique_ptr<Strategy> strategy = MakeStrategy(options.strategy);
    const SolveSummary summary = strategy->Solve(problem.builder(), solver, &followed.state);
    distances = Distances(fit, graph, followed.state, given);
    if (!summary.IsUsable()) break;
  }
  followed.misfit = WeightedMean(distances, given);
  return followed;
}

std::vector<DeformationState> IntrinsicStarts(const UnitFit& fit, const BuiltGraph& graph) {
  if (fit.target == nullptr) return {};
  const std::function<bool()> should_stop = [&fit] {
    return (fit.options->should_stop && fit.options->should_stop()) ||
           fit.clock->Seconds() >= fit.options->time_limit_s;
  };
  std::vector<FollowedMatches> followed;
  for (IntrinsicMatches& found : MatchIntrinsically(*fit.source, *fit.target, should_stop)) {
    if (should_stop()) return {};
    StatusOr<FollowedMatches> one = FollowMatches(fit, graph, std::move(found.correspondences));
    if (one.ok()) followed.push_back(*std::move(one));
  }
  std::stable_sort(
      followed.begin(), followed.end(), [](const FollowedMatches& a, const FollowedMatches& b) {
        return a.misfit < b.misfit;
      });
  std::vector<DeformationState> starts;
  for (FollowedMatches& one : followed) {
    if (starts.size() >= kMostStarts || one.misfit > kSimilar * followed.front().misfit) break;
    starts.push_back(std::move(one.state));
  }
  return starts;
}

}  // namespace ceres_ed
