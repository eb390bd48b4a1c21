// A part of the graph with indices of its own, so that a level costs what it moves and no more.
#ifndef CERES_ED_SLAM_LEVELS_LEVEL_WINDOW_H_
#define CERES_ED_SLAM_LEVELS_LEVEL_WINDOW_H_

#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/util/memory_use.h>

#include <cstddef>
#include <deque>
#include <vector>

namespace ceres_ed {

// The variable nodes of a level, the held ones that share an edge or a point with them, and every
// edge that touches a variable one. A problem over the window has the residuals, and so the
// minimum, of the same level over the whole graph.
struct LevelWindow {
  // Node of the map for each node of the window, variable ones first.
  std::vector<int> nodes;
  int num_variable = 0;
  DeformationGraph graph;
  DeformationState state;

  // Which of the window's nodes may move.
  ProblemConfig Config(bool camera_variable, SeamEdges seam_edges) const;
};

// Makes windows; keeps its index of nodes from one to the next.
class LevelWindowBuilder {
 public:
  // `variable`: nodes of the map, each once. `held`: more nodes to take in (bound to points of the
  // level); those that share an edge with variable ones are found here.
  LevelWindow Build(const DeformationGraph& graph,
                    const DeformationState& state,
                    const std::vector<int>& variable,
                    const std::vector<int>& held);

  // The window's index of a map node; -1 for one outside. Of the last window built.
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
