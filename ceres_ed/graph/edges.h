// The edges of E_reg: which nodes are linked, and how strongly.
#ifndef CERES_ED_GRAPH_EDGES_H_
#define CERES_ED_GRAPH_EDGES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/skinning.h>

#include <vector>

namespace ceres_ed {

// Returns edges between nodes to which the same points are bound (Sumner et al. 2007), in both
// directions, sorted by (from, to). alpha_jk is proportional to the sum of w_j(v) w_k(v) over all
// points v, so it is the same in both directions. Each node chooses the `edges_per_node` nodes to
// which it is linked most strongly (ties: lowest index); an edge is kept if either end chooses it.
// Weights are limited to [0.1, 10] times their mean, so that no edge is without effect and none
// dominates the energy, and are then scaled to a mean of 1.
std::vector<GraphEdge> SharedInfluenceEdges(const Skinning& skinning,
                                            int num_nodes,
                                            int edges_per_node);

// Returns edges from each node to its `edges_per_node` nearest nodes and back, of weight 1, sorted
// by (from, to). If distances are measured along the surface, only nodes that can be reached count.
std::vector<GraphEdge> NearestNodeEdges(const PointCloud& cloud,
                                        const SurfaceTopology& topology,
                                        const std::vector<int>& node_points,
                                        int edges_per_node,
                                        DistanceRule distance);

// Returns for each node the connected piece to which it belongs. Pieces are numbered by their
// lowest node.
std::vector<int> ConnectedPieces(const DeformationGraph& graph);

// Adds edges of weight 1 (in both directions) until the graph is connected, and returns how many
// pieces there were. Pieces are joined to the largest one, the nearest piece (Euclidean) first.
// Each joint has `edges_per_joint` edges between near nodes, with different ends if there are
// enough nodes, since a piece could turn freely about a single edge.
int JoinPieces(DeformationGraph* graph, int edges_per_joint);

// Adds edges of weight 1 (in both directions) by which pieces of a surface carry the pieces between
// them. `piece` has the piece of each node, and `is_carried` is non-zero for the pieces that are
// carried. Each node of these gets edges to its `edges_per_node` nearest nodes (Euclidean) of other
// pieces, as far as they are within `reach`, in the unit of the positions. Returns the number of
// pairs of nodes that are linked.
int CarryPieces(const std::vector<int>& piece,
                const std::vector<char>& is_carried,
                int edges_per_node,
                double reach,
                DeformationGraph* graph);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_EDGES_H_
