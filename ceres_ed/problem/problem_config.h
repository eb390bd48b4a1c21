// Levels are data: which parameters a subproblem may move, what becomes of the edges that cross its
// seam, and what stands in for nodes that have been eliminated. The builder knows nothing of
// levels.
#ifndef CERES_ED_PROBLEM_PROBLEM_CONFIG_H_
#define CERES_ED_PROBLEM_PROBLEM_CONFIG_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/problem/problem_types.h>

#include <vector>

#include <ceres/cost_function.h>

namespace ceres_ed {

// A residual beyond those of the builder's terms, of weight 1 and without a loss: what eliminated
// nodes leave on those that remain. The cost function must outlive what is built with it.
struct ExtraResidual {
  const ceres::CostFunction* cost = nullptr;
  // In the order of the cost function's parameter blocks.
  std::vector<BlockRef> blocks;
};

// A subset of the full problem. Everything that isn't variable is held by
// ceres::Problem::SetParameterBlockConstant; residuals that touch nothing variable are left out.
struct ProblemConfig {
  // One entry a node: nonzero where the node may move.
  std::vector<char> variable_nodes;
  bool camera_variable = false;
  SeamEdges seam_edges = SeamEdges::kKeep;
  // One entry a node: nonzero where it has been eliminated, which leaves out every residual that
  // touches it. Empty where none is. No variable node is eliminated.
  std::vector<char> eliminated_nodes;
  // In place of what is left out.
  std::vector<ExtraResidual> extra_residuals;

  int NumVariableNodes() const;
};

// The batch problem: every node, and the camera where there is one.
ProblemConfig FullConfig(int num_nodes, bool has_camera);

// Level I (Eq. 14): the PR nodes, `rings` rings of PI nodes around them, and the camera.
ProblemConfig LevelOneConfig(const DeformationGraph& graph,
                             const std::vector<char>& point_relevant,
                             bool has_camera,
                             SeamEdges seam_edges,
                             int rings);

// Level II (Eq. 15): the PI nodes alone; PR nodes and camera are held.
ProblemConfig LevelTwoConfig(const std::vector<char>& point_relevant);

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_PROBLEM_CONFIG_H_
