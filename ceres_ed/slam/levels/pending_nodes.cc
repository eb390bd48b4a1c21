#include "ceres_ed/slam/levels/pending_nodes.h"

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
    // A Gauss-Newton step near the solution leaves an error of the square of its correction.
    Set(window.nodes[i], one_step ? motion[i] * motion[i] : 0.0);
  }
  // A node follows a mean of its neighbours, so the largest motion counts and not their sum.
  farthest_.clear();
  for (int i = 0; i < window.num_variable; ++i) {
    const int node = window.nodes[i];
    for (const int e : graph.incident_edges(node)) {
      const GraphEdge& edge = graph.edges()[e];
      const int other = edge.from == node ? edge.to : edge.from;
      if (!solved_.Has(other)) farthest_.emplace_back(other, motion[i]);
    }
  }
  std::sort(farthest_.begin(), farthest_.end());
  for (std::size_t k = 0; k < farthest_.size(); ++k) {
    const bool is_last = k + 1 == farthest_.size() || farthest_[k + 1].first != farthest_[k].first;
    if (is_last) Raise(farthest_[k].first, farthest_[k].second);
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
