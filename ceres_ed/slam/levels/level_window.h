// A part of the graph with its own indices, so that the cost of a level depends only on the nodes
// that it moves.
#ifndef CERES_ED_SLAM_LEVELS_LEVEL_WINDOW_H_
#define CERES_ED_SLAM_LEVELS_LEVEL_WINDOW_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/solver/decoupling/decoupling.h>
#include <ceres_ed/util/memory_use.h>

#include <cstddef>
#include <deque>
#include <vector>

namespace ceres_ed {

// The nodes for which a level solves, the held nodes that share an edge or a point with them, and
// every edge that touches a node for which it solves. A problem over the window has the same
// residuals, and therefore the same minimum, as the level over the whole graph.
struct LevelWindow {
  // The node of the map for each node of the window: the eliminated nodes first, then those that
  // are moved, then those that are held.
  std::vector<int> nodes;
  int num_eliminated = 0;
  // The number of nodes for which the level solves: the eliminated and the moved ones.
  int num_variable = 0;
  // The number of held nodes that come next and have all of their edges, too: those that the next
  // Level I may move.
  int num_candidates = 0;
  DeformationGraph graph;
  DeformationState state;

  // Returns the level as a problem over the window.
  ProblemConfig Config(bool camera_variable, BoundaryEdges boundary_edges) const;
};

// Builds windows, and keeps its index of nodes from one window to the next.
class LevelWindowBuilder {
 public:
  // Returns a window. `variable` contains nodes of the map, each once. `held` contains additional
  // nodes, to which points of the level are bound; nodes that share an edge with variable ones are
  // found here.
  LevelWindow Build(const DeformationGraph& graph,
                    const DeformationState& state,
                    const std::vector<int>& variable,
                    const std::vector<int>& held);

  // Returns the window of a Level I.
  LevelWindow Build(const DeformationGraph& graph,
                    const DeformationState& state,
                    const Decoupling& nodes);

  // Returns the index of a map node in the last window, or -1 if the node is outside.
  int Local(int node) const { return local_[node]; }

  std::size_t HeapBytes() const { return HeapBytesOf(local_) + HeapBytesOf(taken_); }

 private:
  void Take(const DeformationGraph& graph,
            const DeformationState& state,
            int node,
            LevelWindow* window);

  std::deque<int> local_;
  std::vector<int> taken_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_LEVEL_WINDOW_H_
