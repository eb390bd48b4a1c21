#include "ceres_ed/slam/levels/window_observations.h"

namespace ceres_ed {

WindowObservations::WindowObservations(const FrameObservations& observations,
                                       const LevelWindowBuilder& windows,
                                       const DeformableMap& map,
                                       const LevelWindow& window)
    : skinning_(map.neighbors()) {
  points_.reserve(observations.planes.size() + observations.features.size());
  planes_ = Take(observations.planes, windows);
  features_ = Take(observations.features, windows);
  node_prior_.reserve(window.nodes.size());
  for (const int node : window.nodes) node_prior_.push_back(map.node_prior(node));
}

EnergyContext WindowObservations::Context(const LevelWindow& window) const {
  EnergyContext context;
  context.graph = &window.graph;
  context.points = &points_;
  context.skinning = &skinning_;
  context.correspondences = &planes_;
  context.match_details = &details_;
  context.node_prior = &node_prior_;
  return context;
}

std::vector<Correspondence> WindowObservations::Take(
    const std::vector<MapObservation>& observations, const LevelWindowBuilder& windows) {
  std::vector<Correspondence> correspondences;
  correspondences.reserve(observations.size());
  for (const MapObservation& o : observations) {
    int nodes[kMaxBoundNodes];
    for (int i = 0; i < o.binding.size; ++i) nodes[i] = windows.Local(o.binding.nodes[i]);
    Correspondence c;
    c.point = static_cast<int>(points_.size());
    c.target = o.target;
    c.normal = o.normal;
    c.weight = o.weight;
    if (!o.source_normal.isZero(0.0)) {
      c.detail = static_cast<int>(details_.size());
      details_.emplace_back();
      details_.back().source_normal = o.source_normal;
      details_.back().target_normal = o.normal;
    }
    correspondences.push_back(c);
    points_.push_back(o.position);
    skinning_.Add(nodes, o.binding.weights, o.binding.size);
  }
  return correspondences;
}

}  // namespace ceres_ed
