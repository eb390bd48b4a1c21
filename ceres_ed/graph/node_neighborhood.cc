#include "ceres_ed/graph/node_neighborhood.h"

#include <glog/logging.h>

namespace ceres_ed {

std::vector<char> RingsAround(const DeformationGraph& graph,
                              const std::vector<char>& seeds,
                              int rings) {
  CHECK_EQ(seeds.size(), static_cast<std::size_t>(graph.num_nodes()));
  CHECK_GE(rings, 0);
  NodeSet nodes;
  for (int node = 0; node < graph.num_nodes(); ++node) {
    if (seeds[node] != 0) nodes.Add(node);
  }
  AddRings(
      graph, rings, [](int) { return true; }, &nodes);
  std::vector<char> mask(seeds.size(), 0);
  for (const int node : nodes.nodes()) mask[node] = 1;
  return mask;
}

}  // namespace ceres_ed
