#include "ceres_ed/graph/point_binder.h"

#include <ceres_ed/graph/binding.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Within a body a point follows nodes that are at most this many edges away from the nearest one.
constexpr int kBodyRings = 3;

// Returns the nodes within kBodyRings edges of each node, in ascending order.
std::vector<std::vector<int>> LinkedNodes(const DeformationGraph& graph) {
  std::vector<std::vector<int>> next(graph.num_nodes());
  for (const GraphEdge& edge : graph.edges()) next[edge.from].push_back(edge.to);
  std::vector<std::vector<int>> linked(graph.num_nodes());
  for (int j = 0; j < graph.num_nodes(); ++j) {
    linked[j] = {j};
    for (int ring = 0; ring < kBodyRings; ++ring) {
      const std::vector<int> inner = linked[j];
      for (const int k : inner) linked[j].insert(linked[j].end(), next[k].begin(), next[k].end());
      std::sort(linked[j].begin(), linked[j].end());
      linked[j].erase(std::unique(linked[j].begin(), linked[j].end()), linked[j].end());
    }
  }
  return linked;
}

// Puts a node into the list, which keeps the `capacity` nearest ones. Of nodes that are equally far
// the first one to come stays in front.
void Insert(int node, double distance, int capacity, NearNodes* near) {
  if (near->size == capacity && !(distance < near->distances[capacity - 1])) return;
  int place = near->size < capacity ? near->size++ : capacity - 1;
  for (; place > 0 && distance < near->distances[place - 1]; --place) {
    near->nodes[place] = near->nodes[place - 1];
    near->distances[place] = near->distances[place - 1];
  }
  near->nodes[place] = node;
  near->distances[place] = distance;
}

}  // namespace

PointBinder::PointBinder(std::vector<Eigen::Vector3d> node_positions, int neighbors)
    : neighbors_(neighbors), positions_(std::move(node_positions)), tree_(positions_) {
  CHECK(neighbors >= 1 && neighbors <= kMaxBoundNodes) << neighbors;
  CHECK(!positions_.empty()) << "binding needs a node";
}

PointBinder::PointBinder(const DeformationGraph& graph)
    : neighbors_(kMaxBoundNodes),
      positions_(graph.positions().begin(), graph.positions().end()),
      tree_(positions_),
      linked_(LinkedNodes(graph)) {
  CHECK(!positions_.empty()) << "binding needs a node";
}

PointBinder PointBinder::InSpace(const DeformationGraph& graph, int neighbors) {
  if (graph.num_inner_nodes() > 0) return PointBinder(graph);
  return PointBinder({graph.positions().begin(), graph.positions().end()}, neighbors);
}

PointBinder PointBinder::InBody(const DeformationGraph& graph) { return PointBinder(graph); }

NearNodes PointBinder::Near(const Eigen::Vector3d& point) const {
  if (!linked_.empty()) return NearInBody(point);
  std::array<Neighbor, kMaxBoundNodes + 1> nearest;
  NearNodes near;
  near.size = tree_.KNearest(point, neighbors_ + 1, nearest.data());
  for (int i = 0; i < near.size; ++i) {
    near.nodes[i] = nearest[i].index;
    near.distances[i] = std::sqrt(nearest[i].squared_distance);
  }
  return near;
}

NearNodes PointBinder::NearInBody(const Eigen::Vector3d& point) const {
  const Neighbor nearest = tree_.Nearest(point);
  NearNodes near;
  if (!nearest.found()) return near;
  for (const int j : linked_[nearest.index]) {
    Insert(j, (positions_[j] - point).norm(), neighbors_ + 1, &near);
  }
  return near;
}

BoundNodes PointBinder::Bind(const NearNodes& near) const {
  CHECK_GE(near.size, 1) << "no node is near the point";
  BoundNodes bound;
  bound.size = ComputeWeights(near.distances.data(), near.size, neighbors_, bound.weights.data());
  std::copy_n(near.nodes.begin(), bound.size, bound.nodes.begin());
  return bound;
}

}  // namespace ceres_ed
