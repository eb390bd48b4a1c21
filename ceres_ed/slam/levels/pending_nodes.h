// What has yet to follow: nodes whose surroundings moved since they were last solved.
#ifndef CERES_ED_SLAM_LEVELS_PENDING_NODES_H_
#define CERES_ED_SLAM_LEVELS_PENDING_NODES_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/node_set.h>
#include <ceres_ed/slam/levels/level_window.h>
#include <ceres_ed/util/memory_use.h>

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace ceres_ed {

class CheckpointArchive;

// For each node a bound on how far what pulls at it has moved since it was solved: the farthest
// motion among its neighbours, summed over the solves that it wasn't part of. Lengths are in map
// units; a node's motion is |dt| + |dA|, which is how far it throws a neighbour one spacing away.
class PendingNodes {
 public:
  // Nodes above `tolerance` > 0 are unsettled.
  explicit PendingNodes(double tolerance) : tolerance_(tolerance) {}

  double tolerance() const { return tolerance_; }
  double change(int node) const {
    return node < static_cast<int>(changes_.size()) ? changes_[node] : 0.0;
  }

  // What pulls at `node` has changed by as much as moves it by `change`.
  void Raise(int node, double change);

  // The variable nodes of `window` were solved and moved by `motion`, one entry each. That settles
  // them, up to what is left by `one_step` of Gauss-Newton. Their neighbours outside follow them.
  void NoteSolve(const LevelWindow& window,
                 const DeformationGraph& graph,
                 const std::vector<double>& motion,
                 bool one_step);

  // Unsettled nodes, by number.
  const std::vector<int>& Unsettled();

  std::size_t HeapBytes() const {
    return HeapBytesOf(changes_) + listed_.HeapBytes() + solved_.HeapBytes() +
           HeapBytesOf(farthest_);
  }

  void Exchange(CheckpointArchive* archive);

 private:
  void Set(int node, double change);

  double tolerance_;
  std::deque<double> changes_;
  // Every unsettled node, and some that no longer are.
  NodeSet listed_;
  // For NoteSolve().
  NodeSet solved_;
  std::vector<std::pair<int, double>> farthest_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_PENDING_NODES_H_
