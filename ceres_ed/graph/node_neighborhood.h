// The nodes within a number of edges from other nodes.
#ifndef CERES_ED_GRAPH_NODE_NEIGHBORHOOD_H_
#define CERES_ED_GRAPH_NODE_NEIGHBORHOOD_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/node_set.h>

#include <vector>

namespace ceres_ed {

// Adds to `nodes` every node that is at most `rings` >= 0 edges (in either direction) away from a
// node in the set, ring by ring. A node for which `admits(node)` is false is not added, and the
// rings do not pass through it.
template <typename Admits>
void AddRings(const DeformationGraph& graph, int rings, Admits admits, NodeSet* nodes) {
  int begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const int end = nodes->size();
    for (int i = begin; i < end; ++i) {
      const int node = nodes->nodes()[i];
      for (const int e : graph.incident_edges(node)) {
        const GraphEdge& edge = graph.edges()[e];
        const int other = edge.from == node ? edge.to : edge.from;
        if (!nodes->Has(other) && admits(other)) nodes->Add(other);
      }
    }
    begin = end;
  }
}

// Returns 1 for every node that is at most `rings` >= 0 edges (in either direction) away from a
// node with a non-zero entry in `seeds`, and for the seeds themselves. `seeds` and the result have
// one element for each node.
std::vector<char> RingsAround(const DeformationGraph& graph,
                              const std::vector<char>& seeds,
                              int rings);

}  // namespace ceres_ed

#endif  // CERES_ED_GRAPH_NODE_NEIGHBORHOOD_H_
