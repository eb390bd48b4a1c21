// Levels are data: which parameters a subproblem may move, and what becomes of the edges that cross
// its seam. The builder knows nothing of levels.
#ifndef CERES_ED_PROBLEM_PROBLEM_CONFIG_H_
#define CERES_ED_PROBLEM_PROBLEM_CONFIG_H_

#include <ceres_ed/graph/deformation_graph.h>

#include <vector>

namespace ceres_ed {

// What happens to a prior residual between a variable and a held node.
enum class SeamEdges {
  // It stays, and pulls toward where the held node was ("fixing Phi_2", Eq. 14).
  kKeep,
  // It is left out, as in the paper's figure on node types. The seam may tear.
  kCut,
};

// A subset of the full problem. Everything that isn't variable is held by
// ceres::Problem::SetParameterBlockConstant; residuals that touch nothing variable are left out.
struct ProblemConfig {
  // One entry a node: nonzero where the node may move.
  std::vector<char> variable_nodes;
  bool camera_variable = false;
  SeamEdges seam_edges = SeamEdges::kKeep;

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
