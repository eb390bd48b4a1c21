// From a surface to its deformation graph.
#ifndef CERES_ED_GRAPH_GRAPH_BUILDER_H_
#define CERES_ED_GRAPH_GRAPH_BUILDER_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

struct SurfaceTopology;

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
