// From a surface to its deformation graph.
#ifndef CERES_ED_GRAPH_GRAPH_BUILDER_H_
#define CERES_ED_GRAPH_GRAPH_BUILDER_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// How nodes are chosen among the points.
enum class SamplingRule {
  // UniformDownsample: no two nodes nearer than the spacing, every point within it.
  kUniform,
  // FarthestPointSample: more even, and hits target_nodes exactly; slower.
  kFarthest,
};

// Which nodes share an edge.
enum class EdgeRule {
  // SharedInfluenceEdges (Sumner et al. 2007).
  kSharedInfluence,
  // NearestNodeEdges, alpha = 1.
  kNearest,
};

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
};

struct BuiltGraph {
  DeformationGraph graph;
  // The binding of every point of the cloud.
  Skinning skinning;
  // The point that each node sits on.
  std::vector<int> node_points;
  // The rule by which `skinning` was made, with the distance that was really used: what
  // BindCloudToGraph needs to bind another cloud the same way.
  BindingOptions binding;
  // The spacing that was used, in the unit of the points; 0 where a count alone decided.
  double node_spacing = 0.0;
  // Pieces of the graph before they were joined; 1 for a graph that hangs together by itself.
  int num_pieces = 0;
  // One sentence each, for the user.
  std::vector<std::string> warnings;
};

// The graph of `cloud`, whose topology is `topology`. Fails on bad options, on a cloud without
// points or without extent, and on more nodes wanted than there are points to put them on. Two runs
// give the same bits; scaling points and spacing together scales the positions and changes nothing
// else.
StatusOr<BuiltGraph> BuildGraph(const PointCloud& cloud,
                                const SurfaceTopology& topology,
                                const GraphOptions& options);

// The same, and builds the topology itself.
StatusOr<BuiltGraph> BuildGraph(const PointCloud& cloud, const GraphOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_GRAPH_BUILDER_H_
