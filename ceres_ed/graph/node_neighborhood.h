// Nodes within a number of hops.
#ifndef CERES_ED_GRAPH_NODE_NEIGHBORHOOD_H_
#define CERES_ED_GRAPH_NODE_NEIGHBORHOOD_H_

#include <ceres_ed/graph/deformation_graph.h>

#include <vector>

namespace ceres_ed {

// 1 for every node that is at most `rings` >= 0 edges (in either direction) from a node with a
// non-zero `seeds`, the seeds included. `seeds` and the result have one element a node.
std::vector<char> RingsAround(const DeformationGraph& graph,
                              const std::vector<char>& seeds,
                              int rings);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_NODE_NEIGHBORHOOD_H_
