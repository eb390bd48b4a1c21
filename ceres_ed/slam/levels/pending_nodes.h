// Records which nodes still have to be moved because their surroundings moved since they were last
// solved.
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

// For each node a bound on the change of the forces on it since it was last solved: the largest
// motion among its neighbours, summed over the solves in which the node did not take part. Lengths
// are in map units. The motion of a node is |dt| + |dA|, which is the displacement that it imposes
// on a neighbour at a distance of one spacing.
class PendingNodes {
 public:
  // A node with a change above `tolerance` > 0 is unsettled.
  explicit PendingNodes(double tolerance) : tolerance_(tolerance) {}

  double tolerance() const { return tolerance_; }
  // Returns the change of a node, in map units.
  double change(int node) const {
    return node < static_cast<int>(changes_.size()) ? changes_[node] : 0.0;
  }

  // Adds `change` to a node: the forces on it have changed so much that it would move by this
  // distance.
  void Raise(int node, double change);

  // Records that the variable nodes of `window` were solved and moved by `motion` (one entry each).
  // They become settled, except for the error that `one_step` of the Gauss-Newton method leaves.
  // Their neighbours outside the window receive their motion.
  void NoteSolve(const LevelWindow& window,
                 const DeformationGraph& graph,
                 const std::vector<double>& motion,
                 bool one_step);

  // Returns the unsettled nodes in ascending order.
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
  // Every unsettled node, and some that are settled again.
  NodeSet listed_;
  // Temporary data of NoteSolve().
  NodeSet solved_;
  std::vector<std::pair<int, double>> farthest_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_PENDING_NODES_H_
