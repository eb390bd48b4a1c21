// Which nodes carry a point, and how much: Eq. 2.
#ifndef CERES_ED_GRAPH_BINDING_H_
#define CERES_ED_GRAPH_BINDING_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/graph_options.h>
#include <ceres_ed/graph/skinning.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Writes the weights of a point's nearest nodes and returns how many nodes carry it (a prefix of
// the list, in [1, neighbors]; weights are positive, never increase, and sum to 1).
//   w_j = 1 - d_j / d_max, normalised (Eq. 2), with d_max the distance to node neighbors + 1.
// `distances` are `count` >= 1 distances in ascending order, of which the first neighbors + 1 are
// used; infinite ones at the end count as absent. What the paper leaves open:
//   - Only k <= neighbors nodes there: d_max = d_k (1 + 1 / k), as if one more node stood a step
//     behind the last. All k carry the point; one node carries it alone.
//   - A node as far as d_max (to a relative 1e-9) weighs nothing and is dropped.
//   - All neighbors + 1 equally far, or all at the point: the first `neighbors` weigh the same.
//   - A point on a node: w = 1 before the normalisation, as Eq. 2 says; the others still count.
int ComputeWeights(const double* distances, int count, int neighbors, double* weights);

// The binding of every point of `cloud` to nodes that are some of its points. Along the surface,
// points that no node reaches (isolated vertices, islands without a node) are bound to the nodes
// nearest in space. `topology` is that of `cloud`; `node_points` is not empty.
Skinning BindPoints(const PointCloud& cloud,
                    const SurfaceTopology& topology,
                    const std::vector<int>& node_points,
                    const BindingOptions& options);

// The binding of any other cloud near the graph's rest shape, which need not share a point with the
// cloud that the graph was built on. Along the surface every node enters at the nearest vertex (in
// a triangle) of `cloud`, with the distance to it added. For the cloud that the graph was built on
// the result equals BindPoints to the bit. Fails on a graph without nodes and on bad options.
StatusOr<Skinning> BindCloudToGraph(const PointCloud& cloud,
                                    const DeformationGraph& graph,
                                    const BindingOptions& options);

// The same with the topology of `cloud` at hand.
StatusOr<Skinning> BindCloudToGraph(const PointCloud& cloud,
                                    const SurfaceTopology& topology,
                                    const DeformationGraph& graph,
                                    const BindingOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_BINDING_H_
