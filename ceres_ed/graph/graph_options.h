// How a deformation graph is made of a surface.
#ifndef CERES_ED_GRAPH_GRAPH_OPTIONS_H_
#define CERES_ED_GRAPH_GRAPH_OPTIONS_H_

#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/options_fwd.h>

#include <array>
#include <string>

namespace ceres_ed {

// How far a point is from a node.
enum class DistanceRule {
  // Along the surface; Euclidean where there are no triangles.
  kSurface,
  kEuclidean,
};

constexpr std::array<NamedValue<DistanceRule>, 2> NamesOf(DistanceRule) {
  return {{{"surface", DistanceRule::kSurface}, {"euclidean", DistanceRule::kEuclidean}}};
}

// How points are bound to nodes.
struct BindingOptions {
  // m of Eq. 2: nodes a point, in [1, kMaxBoundNodes].
  int neighbors = 4;
  DistanceRule distance = DistanceRule::kSurface;
  // Threads of the Euclidean search; the result does not depend on it.
  int num_threads = 1;

  // False, with a sentence in `error`, when a value is out of range.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<BindingOptions>& Rows();
};

// How nodes are chosen among the points.
enum class SamplingRule {
  // UniformDownsample: no two nodes nearer than the spacing, every point within it.
  kUniform,
  // FarthestPointSample: more even, and hits target_nodes exactly; slower.
  kFarthest,
};

constexpr std::array<NamedValue<SamplingRule>, 2> NamesOf(SamplingRule) {
  return {{{"uniform", SamplingRule::kUniform}, {"farthest", SamplingRule::kFarthest}}};
}

// Which nodes share an edge.
enum class EdgeRule {
  // SharedInfluenceEdges (Sumner et al. 2007).
  kSharedInfluence,
  // NearestNodeEdges, alpha = 1.
  kNearest,
};

constexpr std::array<NamedValue<EdgeRule>, 2> NamesOf(EdgeRule) {
  return {{{"shared_influence", EdgeRule::kSharedInfluence}, {"nearest", EdgeRule::kNearest}}};
}

struct GraphOptions {
  SamplingRule sampling = SamplingRule::kUniform;
  // Distance of sampling, binding and nearest-node edges.
  DistanceRule distance = DistanceRule::kSurface;
  // Distance between nodes in the unit of the points, >= 0; 0 = from target_nodes.
  double node_spacing = 0.0;
  // Number of nodes wanted where node_spacing is 0, >= 0 (kUniform comes within about 5 %);
  // 0 = a spacing of auto_spacing times the diagonal, but no less than two mean edge lengths.
  int target_nodes = 0;
  // Fraction of the bounding box's diagonal, > 0.
  double auto_spacing = 0.05;
  // m of Eq. 2: nodes a point, in [1, kMaxBoundNodes].
  int neighbors = 4;
  EdgeRule edges = EdgeRule::kSharedInfluence;
  // Partners that a node keeps, >= 1; it may have more, for an edge stays if either end keeps it.
  int edges_per_node = 8;
  // Mesh components of fewer positions get no node of their own and follow the nodes nearest in
  // space; >= 1.
  int min_component_points = 10;
  // Join the pieces of the graph so that none is left behind.
  bool join_pieces = true;
  // Edges at each such joint, >= 1; three hold a piece against turning.
  int edges_per_joint = 3;
  // >= 1; the result does not depend on it.
  int num_threads = 1;

  // False, with a sentence in `error`, when a value is out of range.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<GraphOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_GRAPH_OPTIONS_H_
