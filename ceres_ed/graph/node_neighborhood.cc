#include "ceres_ed/graph/node_neighborhood.h"

#include <glog/logging.h>

namespace ceres_ed {

std::vector<char> RingsAround(const DeformationGraph& graph,
                              const std::vector<char>& seeds,
                              int rings) {
  CHECK_EQ(seeds.size(), static_cast<std::size_t>(graph.num_nodes()));
  CHECK_GE(rings, 0);
  std::vector<char> mask(seeds.size(), 0);
  std::vector<int> ring;
  for (int node = 0; node < graph.num_nodes(); ++node) {
    if (seeds[node] == 0) continue;
    mask[node] = 1;
    ring.push_back(node);
  }
  std::vector<int> next_ring;
  for (int hop = 0; hop < rings && !ring.empty(); ++hop) {
    next_ring.clear();
    for (const int node : ring) {
      for (const int e : graph.incident_edges(node)) {
        const GraphEdge& edge = graph.edges()[e];
        const int other = edge.from == node ? edge.to : edge.from;
        if (mask[other] != 0) continue;
        mask[other] = 1;
        next_ring.push_back(other);
      }
    }
    ring.swap(next_ring);
  }
  return mask;
}

}  // namespace ceres_ed
