// A part of the graph with indices of its own, so that a level costs what it moves and no more.
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

// The nodes that a level solves for, the held ones that share an edge or a point with them, and
// every edge that touches one that it solves for. A problem over the window has the residuals, and
// so the minimum, of the same level over the whole graph.
struct LevelWindow {
  // Node of the map for each node of the window: the eliminated ones first, then those that are
  // moved, then those that are held.
  std::vector<int> nodes;
  int num_eliminated = 0;
  // The eliminated and the moved ones: those that the level solves for.
  int num_variable = 0;
  DeformationGraph graph;
  DeformationState state;

  // The level as a problem over the window.
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

  // The window of a Level I.
  LevelWindow Build(const DeformationGraph& graph,
                    const DeformationState& state,
                    const Decoupling& nodes);

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
