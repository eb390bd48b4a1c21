#include "ceres_ed/registration/hypotheses/model_selection.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/matching.h>
#include <ceres_ed/registration/moving_samples.h>
#include <ceres_ed/registration/rigid_motion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ceres_ed {
namespace {

// The number of points of each surface that are matched.
constexpr int kSamples = 6000;
// The distance that two meshes of one surface leave between them, as a part of an edge.
constexpr double kPerEdge = 0.02;
// A deformation explains more if the variance at a node falls by the first factor, or the mean of
// the logarithms by the second value.
constexpr double kAtOneNode = 6.0;
constexpr double kInTheMean = 0.5;
// Fewer pairs say nothing of the variance at a node.
constexpr double kLeastPairs = 8.0;
// A rigid motion that finds fewer pairs than this share of those of the deformation leaves out what
// it does not explain.
constexpr double kLeastShare = 0.99;

// The distances of a state across the surfaces, summed for each node.
struct Residuals {
  std::vector<double> squared;
  std::vector<double> pairs;
  std::vector<Correspondence> matches;

  double Total() const {
    double sum = 0.0;
    for (const double part : squared) sum += part;
    return matches.empty() ? std::numeric_limits<double>::infinity()
                           : sum / static_cast<double>(matches.size());
  }
};

// Measures states on the same samples.
class Ruler {
 public:
  Ruler(const UnitFit& fit, const BuiltGraph& graph)
      : fit_(fit),
        graph_(graph),
        moving_(*fit.source, graph, kSamples),
        target_samples_(SamplePoints(*fit.target, kSamples)) {}

  Residuals Measure(const DeformationState& state) {
    const int num_nodes = graph_.graph.num_nodes();
    Residuals residuals;
    residuals.squared.assign(num_nodes, 0.0);
    residuals.pairs.assign(num_nodes, 0.0);
    // What lies far off counts here, whatever the others do.
    MatchingOptions options = fit_.options->matching;
    options.max_deviations = std::numeric_limits<double>::infinity();
    options.with_details = false;
    moving_.Move(state, fit_.options->num_threads);
    residuals.matches =
        MatchBothWays(moving_.Moved(), *fit_.target, target_samples_, options).correspondences;
    for (const Correspondence& match : residuals.matches) {
      const int node = NodeOf(match.point);
      const double distance = match.normal.dot(Moved(state, match.point) - match.target);
      residuals.squared[node] += distance * distance;
      residuals.pairs[node] += 1.0;
    }
    return residuals;
  }

  Eigen::Vector3d Moved(const DeformationState& state, int point) const {
    return WarpPoint(
        graph_.graph, state, graph_.skinning[point], fit_.source->cloud().points[point]);
  }

 private:
  // Returns the node that moves a point most.
  int NodeOf(int point) const {
    const Binding binding = graph_.skinning[point];
    const double* largest = std::max_element(binding.weights, binding.weights + binding.size);
    return binding.nodes[largest - binding.weights];
  }

  const UnitFit& fit_;
  const BuiltGraph& graph_;
  MovingSamples moving_;
  std::vector<int> target_samples_;
};

// Returns whether `deformed` leaves clearly less than `rigid`; `least` is s^2.
bool ExplainsMore(const Residuals& deformed, const Residuals& rigid, double least) {
  const double share = kLeastShare * static_cast<double>(deformed.matches.size());
  if (static_cast<double>(rigid.matches.size()) < share) return true;
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t j = 0; j < deformed.pairs.size(); ++j) {
    if (std::min(deformed.pairs[j], rigid.pairs[j]) < kLeastPairs) continue;
    const double ratio = (rigid.squared[j] / rigid.pairs[j] + least) /
                         (deformed.squared[j] / deformed.pairs[j] + least);
    if (ratio > kAtOneNode) return true;
    sum += rigid.pairs[j] * std::log(ratio);
    weight += rigid.pairs[j];
  }
  return sum > kInTheMean * weight;
}

}  // namespace

std::optional<DeformationState> RigidModel(const UnitFit& fit,
                                           const BuiltGraph& graph,
                                           const DeformationState& state) {
  const bool is_asked_for =
      !fit.landmarks.empty() || !fit.fixed.empty() || !fit.options->extra_energies.empty();
  if (fit.target == nullptr || is_asked_for || graph.skinning.size() == 0) return std::nullopt;
  Ruler ruler(fit, graph);
  const Residuals deformed = ruler.Measure(state);
  if (deformed.matches.empty()) return std::nullopt;
  std::vector<Correspondence> followed = deformed.matches;
  for (Correspondence& match : followed) match.target = ruler.Moved(state, match.point);
  DeformationState model(graph.graph.num_nodes());
  Residuals rigid = ruler.Measure(model);
  DeformationState nearest = RigidMotion(fit, graph, followed);
  Residuals of_nearest = ruler.Measure(nearest);
  if (of_nearest.Total() < rigid.Total()) {
    std::swap(model, nearest);
    std::swap(rigid, of_nearest);
  }
  const double of_meshes = kPerEdge * MeanEdgeLength(fit.source->topology());
  if (ExplainsMore(deformed, rigid, fit.noise * fit.noise + of_meshes * of_meshes)) {
    return std::nullopt;
  }
  return model;
}

}  // namespace ceres_ed
