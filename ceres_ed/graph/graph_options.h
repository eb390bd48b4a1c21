// Options for building a deformation graph from a surface.
#ifndef CERES_ED_GRAPH_GRAPH_OPTIONS_H_
#define CERES_ED_GRAPH_GRAPH_OPTIONS_H_

#include <ceres_ed/util/named_values.h>

#include <array>
#include <functional>
#include <string>

namespace ceres_ed {

// How the distance from a point to a node is measured.
enum class DistanceRule {
  // Along the surface; Euclidean if there are no triangles.
  kSurface,
  // The straight line in space.
  kEuclidean,
};

constexpr std::array<NamedValue<DistanceRule>, 2> NamesOf(DistanceRule) {
  return {{{"surface", DistanceRule::kSurface}, {"euclidean", DistanceRule::kEuclidean}}};
}

// Options for binding points to nodes.
struct BindingOptions {
  // m of Eq. 2: the number of nodes to which a point is bound, in [1, kMaxBoundNodes].
  int neighbors = 4;
  DistanceRule distance = DistanceRule::kSurface;
  // The number of threads of the Euclidean search, at least 1. The result does not depend on it.
  int num_threads = 1;

  // Returns true if all values are in range. Otherwise returns false and writes a sentence to
  // `error`.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<BindingOptions>& Rows();
};

// How nodes are chosen among the points.
enum class SamplingRule {
  // UniformDownsample(): no two nodes are nearer than the spacing, and every point has a node
  // within it.
  kUniform,
  // FarthestPointSample(): nodes are spread more evenly, and their number is exactly target_nodes.
  // It is slower.
  kFarthest,
};

constexpr std::array<NamedValue<SamplingRule>, 2> NamesOf(SamplingRule) {
  return {{{"uniform", SamplingRule::kUniform}, {"farthest", SamplingRule::kFarthest}}};
}

// Which nodes share an edge.
enum class EdgeRule {
  // SharedInfluenceEdges(): nodes that share points (Sumner et al. 2007).
  kSharedInfluence,
  // NearestNodeEdges(): the nearest nodes, with alpha = 1.
  kNearest,
};

constexpr std::array<NamedValue<EdgeRule>, 2> NamesOf(EdgeRule) {
  return {{{"shared_influence", EdgeRule::kSharedInfluence}, {"nearest", EdgeRule::kNearest}}};
}

// Options for building a graph.
struct GraphOptions {
  SamplingRule sampling = SamplingRule::kUniform;
  // The distance used for sampling, for binding and for the edges to nearest nodes.
  DistanceRule distance = DistanceRule::kSurface;
  // The distance between nodes in the unit of the points, >= 0. With 0 it follows from
  // target_nodes.
  double node_spacing = 0.0;
  // The number of nodes wanted, >= 0; used if node_spacing is 0. (With kUniform the number differs
  // by up to about 5 %.) With 0 the spacing is auto_spacing times the diagonal, but at least two
  // mean edge lengths.
  int target_nodes = 0;
  // The automatic spacing as a fraction of the diagonal of the bounding box, > 0.
  double auto_spacing = 0.05;
  // m of Eq. 2: the number of nodes to which a point is bound, in [1, kMaxBoundNodes].
  int neighbors = 4;
  EdgeRule edges = EdgeRule::kSharedInfluence;
  // The number of edges that a node chooses, >= 1. It may have more, since an edge is kept if
  // either end chooses it.
  int edges_per_node = 8;
  // Components of a mesh with fewer positions than this get no node. They follow the nodes that are
  // nearest in space. >= 1.
  int min_component_points = 10;
  // Whether the graph also has nodes inside the surface, which must be closed, and edges through
  // the body (AddVolume()). It needs distances along the surface.
  bool volume = false;
  // The weight of the edges of inner nodes, >= 0; those along the surface have the mean 1.
  double volume_weight = 0.03;
  // Called from time to time; if it returns true, BuildGraph() ends with an error.
  std::function<bool()> should_stop;
  // If true, the connected pieces of the graph are joined by edges, so that they move together.
  bool join_pieces = true;
  // The number of edges at each such joint, >= 1. Three edges keep a piece from turning.
  int edges_per_joint = 3;
  // The number of threads, >= 1. The result does not depend on it.
  int num_threads = 1;

  // Returns true if all values are in range. Otherwise returns false and writes a sentence to
  // `error`.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<GraphOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_GRAPH_OPTIONS_H_
