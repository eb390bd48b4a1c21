#include "ceres_ed/slam/pending_nodes.h"

#include <algorithm>

#include <glog/logging.h>

namespace ceres_ed {

void PendingNodes::Set(int node, double change) {
  if (node >= static_cast<int>(changes_.size())) changes_.resize(node + 1, 0.0);
  changes_[node] = change;
  if (change > tolerance_) listed_.Add(node);
}

void PendingNodes::Raise(int node, double change) {
  if (change > 0.0) Set(node, this->change(node) + change);
}

void PendingNodes::NoteSolve(const LevelWindow& window,
                             const DeformationGraph& graph,
                             const std::vector<double>& motion,
                             bool one_step) {
  CHECK_EQ(motion.size(), static_cast<std::size_t>(window.num_variable));
  solved_.Clear();
  for (int i = 0; i < window.num_variable; ++i) {
    solved_.Add(window.nodes[i]);
    // A Gauss-Newton step from nearby leaves the square of what it corrects.
    Set(window.nodes[i], one_step ? motion[i] * motion[i] : 0.0);
  }
  for (int i = 0; i < window.num_variable; ++i) {
    const int node = window.nodes[i];
    for (const int e : graph.incident_edges(node)) {
      const GraphEdge& edge = graph.edges()[e];
      // Edges come in pairs, one each way: one of the two tells.
      if (edge.from == node && !solved_.Has(edge.to)) Raise(edge.to, motion[i]);
    }
  }
}

const std::vector<int>& PendingNodes::Unsettled() {
  std::vector<int> unsettled;
  for (const int node : listed_.nodes()) {
    if (changes_[node] > tolerance_) unsettled.push_back(node);
  }
  listed_.Clear();
  std::sort(unsettled.begin(), unsettled.end());
  for (const int node : unsettled) listed_.Add(node);
  return listed_.nodes();
}

}  // namespace ceres_ed
