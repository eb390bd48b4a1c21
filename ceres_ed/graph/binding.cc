#include "ceres_ed/graph/binding.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/surface_distance.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// A weight below this is a rounding error of a tie.
constexpr double kMinWeight = 1e-9;

// The nodes and weights of one point, before they are added to a Skinning.
struct BoundNodes {
  std::array<int, kMaxBoundNodes> nodes;
  std::array<double, kMaxBoundNodes> weights;
  int size = 0;
};

BoundNodes BindToNearestInSpace(const KdTree& node_tree,
                                const Eigen::Vector3d& point,
                                int neighbors) {
  std::array<Neighbor, kMaxBoundNodes + 1> nearest;
  std::array<double, kMaxBoundNodes + 1> distances;
  const int count = node_tree.KNearest(point, neighbors + 1, nearest.data());
  CHECK_GE(count, 1) << "no node near " << point.transpose();
  for (int i = 0; i < count; ++i) distances[i] = std::sqrt(nearest[i].squared_distance);
  BoundNodes bound;
  bound.size = ComputeWeights(distances.data(), count, neighbors, bound.weights.data());
  for (int i = 0; i < bound.size; ++i) bound.nodes[i] = nearest[i].index;
  return bound;
}

// Binds each point to the nodes nearest in space.
Skinning BindInSpace(const std::vector<Eigen::Vector3d>& points,
                     const std::vector<Eigen::Vector3d>& node_positions,
                     const BindingOptions& options) {
  const KdTree node_tree(node_positions);
  std::vector<BoundNodes> bound(points.size());
  ParallelFor(options.num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      bound[p] = BindToNearestInSpace(node_tree, points[p], options.neighbors);
    }
  });
  Skinning skinning(options.neighbors);
  for (const BoundNodes& b : bound) skinning.Add(b.nodes.data(), b.weights.data(), b.size);
  return skinning;
}

// Binds each point to the nodes nearest along the surface, or in space if no node reaches it.
Skinning BindAlongSurface(const std::vector<Eigen::Vector3d>& points,
                          const SurfaceTopology& topology,
                          const std::vector<Eigen::Vector3d>& node_positions,
                          const std::vector<int>& node_points,
                          const std::vector<double>& offsets,
                          int neighbors,
                          const std::function<bool()>& should_stop) {
  const NearestSeeds nearest =
      NearestSeedsAlongSurface(topology, node_points, neighbors + 1, offsets, should_stop);
  const KdTree node_tree(node_positions);
  Skinning skinning(neighbors);
  std::array<double, kMaxBoundNodes> weights;
  for (int p = 0; p < static_cast<int>(points.size()); ++p) {
    const int count = nearest.Count(p);
    if (count == 0) {
      const BoundNodes bound = BindToNearestInSpace(node_tree, points[p], neighbors);
      skinning.Add(bound.nodes.data(), bound.weights.data(), bound.size);
      continue;
    }
    const int size = ComputeWeights(nearest.DistancesOf(p), count, neighbors, weights.data());
    skinning.Add(nearest.SeedsOf(p), weights.data(), size);
  }
  return skinning;
}

// Finds for each node the nearest point that has a triangle (its representative), and the distance
// to it.
void EnterSurface(const PointCloud& cloud,
                  const SurfaceTopology& topology,
                  const DeformationGraph& graph,
                  std::vector<int>* entry_points,
                  std::vector<double>* offsets) {
  std::vector<int> on_surface;
  std::vector<Eigen::Vector3d> positions;
  for (int p = 0; p < topology.num_points(); ++p) {
    if (topology.is_isolated[p] || topology.representative[p] != p) continue;
    on_surface.push_back(p);
    positions.push_back(cloud.points[p]);
  }
  const KdTree tree(positions);
  for (const Eigen::Vector3d& node : graph.positions()) {
    const Neighbor nearest = tree.Nearest(node);
    CHECK(nearest.found()) << "node at " << node.transpose();
    entry_points->push_back(on_surface[nearest.index]);
    offsets->push_back(std::sqrt(nearest.squared_distance));
  }
}

}  // namespace

int ComputeWeights(const double* distances, int count, int neighbors, double* weights) {
  CHECK_GE(neighbors, 1);
  int used = std::min(count, neighbors + 1);
  while (used > 0 && !std::isfinite(distances[used - 1])) --used;
  CHECK_GE(used, 1) << "no node at a finite distance";
  const int carriers = std::min(used, neighbors);
  // d_max as in Eq. 2; if there are too few nodes, as if one more lay one step behind the last.
  const double d_max =
      used > neighbors ? distances[neighbors] : distances[used - 1] * (1.0 + 1.0 / used);
  int size = 0;
  double sum = 0.0;
  while (size < carriers) {
    const double weight = d_max > 0.0 ? 1.0 - distances[size] / d_max : 0.0;
    if (weight < kMinWeight) break;
    weights[size++] = weight;
    sum += weight;
  }
  // All nodes are equally far, or all at the point.
  if (size == 0) {
    std::fill_n(weights, carriers, 1.0 / carriers);
    return carriers;
  }
  for (int i = 0; i < size; ++i) weights[i] /= sum;
  return size;
}

Skinning BindPoints(const PointCloud& cloud,
                    const SurfaceTopology& topology,
                    const std::vector<int>& node_points,
                    const BindingOptions& options,
                    const std::function<bool()>& should_stop) {
  std::string error;
  CHECK(options.IsValid(&error)) << error;
  CHECK(!node_points.empty()) << "binding needs a node";
  std::vector<Eigen::Vector3d> node_positions;
  node_positions.reserve(node_points.size());
  for (const int point : node_points) node_positions.push_back(cloud.points[point]);
  if (options.distance == DistanceRule::kEuclidean || !topology.HasSurface()) {
    return BindInSpace(cloud.points, node_positions, options);
  }
  return BindAlongSurface(
      cloud.points, topology, node_positions, node_points, {}, options.neighbors, should_stop);
}

StatusOr<Skinning> BindCloudToGraph(const PointCloud& cloud,
                                    const DeformationGraph& graph,
                                    const BindingOptions& options) {
  if (options.distance == DistanceRule::kEuclidean) {
    return BindCloudToGraph(cloud, SurfaceTopology(), graph, options);
  }
  return BindCloudToGraph(cloud, BuildTopology(cloud), graph, options);
}

StatusOr<Skinning> BindCloudToGraph(const PointCloud& cloud,
                                    const SurfaceTopology& topology,
                                    const DeformationGraph& graph,
                                    const BindingOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) return Status::Error("bad binding: " + error);
  if (graph.num_nodes() == 0) return Status::Error("cannot bind points to a graph without nodes");
  const std::vector<Eigen::Vector3d> node_positions(graph.positions().begin(),
                                                    graph.positions().end());
  if (options.distance == DistanceRule::kEuclidean || !topology.HasSurface()) {
    return BindInSpace(cloud.points, node_positions, options);
  }
  std::vector<int> entry_points;
  std::vector<double> offsets;
  EnterSurface(cloud, topology, graph, &entry_points, &offsets);
  return BindAlongSurface(
      cloud.points, topology, node_positions, entry_points, offsets, options.neighbors, {});
}

}  // namespace ceres_ed
