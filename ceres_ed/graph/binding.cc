#include "ceres_ed/graph/binding.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/geometry/surface_distance.h>
#include <ceres_ed/geometry/triangle_area.h>
#include <ceres_ed/graph/point_binder.h>
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
// A node is on a piece of another cloud if it is this near, in node spacings. The piece is a part
// of the surface if it has a node for at most this many squared spacings.
constexpr double kOnSurface = 0.35;
constexpr double kAreaPerNode = 2.0;

// Binds each point by its distances in space.
Skinning BindAll(const std::vector<Eigen::Vector3d>& points,
                 const PointBinder& binder,
                 int num_threads) {
  std::vector<BoundNodes> bound(points.size());
  ParallelFor(num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) bound[p] = binder.Bind(points[p]);
  });
  Skinning skinning(binder.neighbors());
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
  const PointBinder in_space(node_positions, neighbors);
  Skinning skinning(neighbors);
  std::array<double, kMaxBoundNodes> weights;
  for (int p = 0; p < static_cast<int>(points.size()); ++p) {
    const int count = nearest.Count(p);
    if (count == 0) {
      const BoundNodes bound = in_space.Bind(points[p]);
      skinning.Add(bound.nodes.data(), bound.weights.data(), bound.size);
      continue;
    }
    const int size = ComputeWeights(nearest.DistancesOf(p), count, neighbors, weights.data());
    skinning.Add(nearest.SeedsOf(p), weights.data(), size);
  }
  return skinning;
}

// Where the nodes of a surface enter a cloud: for each of them the nearest point that has a
// triangle (its representative), and the distance to it.
struct SurfaceEntries {
  std::vector<int> points;
  std::vector<double> offsets;
};

// Returns the entries of the surface's nodes into the pieces of `cloud` for which `is_left_out` is
// 0. There must be such a piece that has triangles.
SurfaceEntries EnterSurface(const PointCloud& cloud,
                            const SurfaceTopology& topology,
                            const DeformationGraph& graph,
                            const std::vector<char>& is_left_out) {
  std::vector<int> on_surface;
  std::vector<Eigen::Vector3d> positions;
  for (int p = 0; p < topology.num_points(); ++p) {
    if (topology.is_isolated[p] || topology.representative[p] != p) continue;
    if (is_left_out[topology.component[p]] != 0) continue;
    on_surface.push_back(p);
    positions.push_back(cloud.points[p]);
  }
  const KdTree tree(positions);
  SurfaceEntries entries;
  for (int j = 0; j < graph.num_surface_nodes(); ++j) {
    const Neighbor nearest = tree.Nearest(graph.position(j));
    CHECK(nearest.found()) << "node at " << graph.position(j).transpose();
    entries.points.push_back(on_surface[nearest.index]);
    entries.offsets.push_back(std::sqrt(nearest.squared_distance));
  }
  return entries;
}

// Returns for each piece of `cloud` whether it is not the surface of the body that `graph` fills,
// but lies inside it: it has less than one node for kAreaPerNode squared spacings.
std::vector<char> FindInnerPieces(const PointCloud& cloud,
                                  const SurfaceTopology& topology,
                                  const DeformationGraph& graph) {
  std::vector<char> is_inner(topology.num_components(), 0);
  if (graph.num_inner_nodes() == 0) return is_inner;
  const double spacing = SurfaceNodeSpacing(graph);
  const SurfaceEntries entries = EnterSurface(cloud, topology, graph, is_inner);
  std::vector<int> nodes(is_inner.size(), 0);
  for (std::size_t j = 0; j < entries.points.size(); ++j) {
    if (entries.offsets[j] <= kOnSurface * spacing) ++nodes[topology.component[entries.points[j]]];
  }
  std::vector<double> areas(is_inner.size(), 0.0);
  for (const auto& [a, b, c] : cloud.triangles) {
    areas[topology.component[a]] +=
        AreaVector(cloud.points[a], cloud.points[b], cloud.points[c]).norm();
  }
  for (std::size_t piece = 0; piece < is_inner.size(); ++piece) {
    is_inner[piece] =
        nodes[piece] == 0 || nodes[piece] * kAreaPerNode * spacing * spacing < areas[piece];
  }
  return is_inner;
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
    return BindAll(cloud.points,
                   PointBinder(std::move(node_positions), options.neighbors),
                   options.num_threads);
  }
  return BindAlongSurface(
      cloud.points, topology, node_positions, node_points, {}, options.neighbors, should_stop);
}

double SurfaceNodeSpacing(const DeformationGraph& graph) {
  const std::vector<Eigen::Vector3d> positions(
      graph.positions().begin(), graph.positions().begin() + graph.num_surface_nodes());
  if (positions.size() < 2) return 0.0;
  const KdTree tree(positions);
  double sum = 0.0;
  for (const Eigen::Vector3d& position : positions) {
    Neighbor nearest[2];
    tree.KNearest(position, 2, nearest);
    sum += std::sqrt(nearest[1].squared_distance);
  }
  return sum / static_cast<double>(positions.size());
}

Skinning BindInBody(const std::vector<Eigen::Vector3d>& points,
                    const DeformationGraph& graph,
                    int num_threads) {
  return BindAll(points, PointBinder::InBody(graph), num_threads);
}

void BindPiecesInBody(const PointCloud& cloud,
                      const SurfaceTopology& topology,
                      const std::vector<char>& pieces,
                      const DeformationGraph& graph,
                      int num_threads,
                      Skinning* skinning) {
  std::vector<Eigen::Vector3d> positions;
  const auto is_chosen = [&](int point) { return pieces[topology.component[point]] != 0; };
  for (int p = 0; p < topology.num_points(); ++p) {
    if (is_chosen(p)) positions.push_back(cloud.points[p]);
  }
  if (positions.empty()) return;
  const Skinning inner = BindInBody(positions, graph, num_threads);
  Skinning merged(kMaxBoundNodes);
  std::size_t next = 0;
  for (int p = 0; p < topology.num_points(); ++p) {
    const Binding binding = is_chosen(p) ? inner[next++] : (*skinning)[p];
    merged.Add(binding.nodes, binding.weights, binding.size);
  }
  *skinning = std::move(merged);
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
  const std::vector<Eigen::Vector3d> node_positions(
      graph.positions().begin(), graph.positions().begin() + graph.num_surface_nodes());
  if (options.distance == DistanceRule::kEuclidean || !topology.HasSurface()) {
    return BindAll(
        cloud.points, PointBinder::InSpace(graph, options.neighbors), options.num_threads);
  }
  const std::vector<char> is_inner = FindInnerPieces(cloud, topology, graph);
  if (std::all_of(is_inner.begin(), is_inner.end(), [](char inner) { return inner != 0; })) {
    return BindInBody(cloud.points, graph, options.num_threads);
  }
  const SurfaceEntries entries = EnterSurface(cloud, topology, graph, is_inner);
  Skinning skinning = BindAlongSurface(cloud.points,
                                       topology,
                                       node_positions,
                                       entries.points,
                                       entries.offsets,
                                       options.neighbors,
                                       {});
  BindPiecesInBody(cloud, topology, is_inner, graph, options.num_threads, &skinning);
  return skinning;
}

}  // namespace ceres_ed
