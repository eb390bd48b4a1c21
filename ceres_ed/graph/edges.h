// The edges of E_reg: which nodes predict one another, and how strongly.
#ifndef CERES_ED_GRAPH_EDGES_H_
#define CERES_ED_GRAPH_EDGES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/skinning.h>

#include <vector>

namespace ceres_ed {

// Edges between nodes that carry the same points (Sumner et al. 2007), in both directions, sorted
// by (from, to). alpha_jk is proportional to the sum over all points of w_j(v) w_k(v), so it is the
// same both ways. Each node keeps its `edges_per_node` strongest partners (ties: lowest index); an
// edge stays if either end keeps it. Weights are cut to [0.1, 10] times their mean, so that no edge
// is without effect or rules the energy, and then scaled to a mean of 1.
std::vector<GraphEdge> SharedInfluenceEdges(const Skinning& skinning,
                                            int num_nodes,
                                            int edges_per_node);

// Edges from each node to its `edges_per_node` nearest nodes and back, of weight 1, sorted by
// (from, to). Along the surface only nodes that can be reached count.
std::vector<GraphEdge> NearestNodeEdges(const PointCloud& cloud,
                                        const SurfaceTopology& topology,
                                        const std::vector<int>& node_points,
                                        int edges_per_node,
                                        DistanceRule distance);

// The piece of every node, numbered by lowest node: nodes are in one piece when edges join them.
std::vector<int> ConnectedPieces(const DeformationGraph& graph);

// Adds edges of weight 1 (both directions) until the graph is one piece, and returns how many
// pieces there were. Pieces join the largest one by one, the nearest (Euclidean) first, each with
// `edges_per_joint` edges between near nodes, with different ends as far as there are enough: one
// edge alone would let a piece turn freely about it.
int JoinPieces(DeformationGraph* graph, int edges_per_joint);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_EDGES_H_
