// Builds the deformation graph of a surface.
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

// A graph together with the binding of the cloud from which it was built.
struct BuiltGraph {
  DeformationGraph graph;
  // The binding of every point of the cloud.
  Skinning skinning;
  // For each node on the surface, the index of the point at which it lies.
  std::vector<int> node_points;
  // The options with which `skinning` was computed, with the distance that was really used.
  // BindCloudToGraph() needs them to bind another cloud in the same way.
  BindingOptions binding;
  // The spacing that was used, in the unit of the points; 0 if only the number of nodes was given.
  double node_spacing = 0.0;
  // The number of edges along the surface; those through the body are behind them.
  int num_surface_edges = 0;
  // The number of connected pieces before they were joined; 1 for a graph that was connected.
  int num_pieces = 0;
  // Warnings for the user, one sentence each.
  std::vector<std::string> warnings;
};

// Returns the graph of `cloud`, whose topology is `topology`. Returns an error for bad options, for
// a cloud without points or with all points at one place, for a point that is not finite, and if
// more nodes are wanted than there are different points, or if options.should_stop ends it. Two
// runs give the same bits. If points and spacing are scaled together, the positions are scaled and
// nothing else changes.
StatusOr<BuiltGraph> BuildGraph(const PointCloud& cloud,
                                const SurfaceTopology& topology,
                                const GraphOptions& options);

// Does the same, and builds the topology itself.
StatusOr<BuiltGraph> BuildGraph(const PointCloud& cloud, const GraphOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_GRAPH_BUILDER_H_
