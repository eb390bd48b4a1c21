// The binding of points to nodes with the weights of Eq. 2.
#ifndef CERES_ED_GRAPH_BINDING_H_
#define CERES_ED_GRAPH_BINDING_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/util/status.h>

#include <functional>
#include <string>
#include <vector>

namespace ceres_ed {

// Computes the weights of a point's nearest nodes:
//   w_j = 1 - d_j / d_max, normalised to sum 1 (Eq. 2)
// where d_max is the distance to node number neighbors + 1. `distances` has `count` >= 1 distances
// in ascending order. The first neighbors + 1 of them are used; infinite ones at the end count as
// absent.
//
// Writes the weights and returns to how many nodes the point is bound. These are the first ones of
// the list; their number is in [1, neighbors]. Weights are positive, never increase, and sum to 1.
// The following cases are not defined by the paper:
//   - There are only k <= neighbors nodes: d_max = d_k (1 + 1 / k), as if one more node lay one
//     step behind the last one. The point is bound to all k; a single node has weight 1.
//   - A node is as far as d_max (to a relative 1e-9): its weight is zero, and it is dropped.
//   - All neighbors + 1 nodes are equally far, or all at the point: the first `neighbors` get the
//     same weight.
//   - The point is at a node: w = 1 before the normalisation, as Eq. 2 says. The others still
//     count.
int ComputeWeights(const double* distances, int count, int neighbors, double* weights);

// Returns the binding of every point of `cloud` to nodes, which are at the points `node_points` of
// the cloud. `topology` is the topology of `cloud`. If distances are measured along the surface,
// points that no node reaches (isolated vertices, components without a node) are bound to the nodes
// nearest in space; so are those that are not reached yet when `should_stop` returns true. Fails a
// CHECK on bad options and if `node_points` is empty.
Skinning BindPoints(const PointCloud& cloud,
                    const SurfaceTopology& topology,
                    const std::vector<int>& node_points,
                    const BindingOptions& options,
                    const std::function<bool()>& should_stop = {});

// Returns the binding of points inside a body to the kMaxBoundNodes nearest nodes of its graph,
// those on its surface and those inside, by the distance in space. (In a volume a point has more
// neighbours around it than on a surface.) Only nodes that are at most three edges away from
// the nearest one count, so that a finger does not follow the finger beside it. Fails a CHECK for a
// graph without nodes.
Skinning BindInBody(const std::vector<Eigen::Vector3d>& points,
                    const DeformationGraph& graph,
                    int num_threads);

// Replaces the binding of all points in the pieces (SurfaceTopology::component) of `cloud` for
// which `pieces` is not 0 by that of BindInBody().
void BindPiecesInBody(const PointCloud& cloud,
                      const SurfaceTopology& topology,
                      const std::vector<char>& pieces,
                      const DeformationGraph& graph,
                      int num_threads,
                      Skinning* skinning);

// Returns the mean distance of a node of the surface from the nearest other one, in the unit of the
// positions; 0 if there is only one.
double SurfaceNodeSpacing(const DeformationGraph& graph);

// Returns the binding of any other cloud near the graph's rest shape. It need not share points with
// the cloud from which the graph was built. If distances are measured along the surface, each node
// starts at the nearest vertex of `cloud` that is in a triangle, and its distance to that vertex is
// added. For the cloud from which the graph was built, the result has the same bits as that of
// BindPoints(). Returns an error for a graph without nodes and for bad options.
//
// If the graph has nodes inside a body, pieces of the cloud that are not the surface of the body
// are bound by BindInBody(): points without triangles, and meshes on which there is less than one
// node for twice the area that a node has on the surface.
StatusOr<Skinning> BindCloudToGraph(const PointCloud& cloud,
                                    const DeformationGraph& graph,
                                    const BindingOptions& options);

// Does the same if the topology of `cloud` is available already.
StatusOr<Skinning> BindCloudToGraph(const PointCloud& cloud,
                                    const SurfaceTopology& topology,
                                    const DeformationGraph& graph,
                                    const BindingOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_BINDING_H_
