// A description of a subproblem as data: the parameters that it may change, what happens to the
// edges that cross its boundary, and the residuals that replace eliminated nodes. The builder does
// not know the levels of the paper; they are configs.
#ifndef CERES_ED_PROBLEM_PROBLEM_CONFIG_H_
#define CERES_ED_PROBLEM_PROBLEM_CONFIG_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/graph/deformation_graph.h>
#include <ceres_ed/problem/problem_types.h>

#include <vector>

#include <ceres/cost_function.h>

namespace ceres_ed {

// A residual in addition to those of the builder's terms, of weight 1 and without a loss. It is
// what eliminated nodes leave for the remaining ones. The cost function must outlive everything
// that is built with it.
struct ExtraResidual {
  const ceres::CostFunction* cost = nullptr;
  // The blocks, in the order of the cost function's parameter blocks.
  std::vector<BlockRef> blocks;
};

// A subset of the full problem. Everything that is not variable is held constant by
// ceres::Problem::SetParameterBlockConstant; residuals that touch nothing variable are left out.
struct ProblemConfig {
  // One entry for each node: nonzero if the node may move.
  std::vector<char> variable_nodes;
  bool camera_variable = false;
  BoundaryEdges boundary_edges = BoundaryEdges::kKeep;
  // One entry for each node: nonzero if it has been eliminated. Every residual that touches an
  // eliminated node is left out. Empty if no node is eliminated. A variable node can't be
  // eliminated.
  std::vector<char> eliminated_nodes;
  // The residuals that replace those left out.
  std::vector<ExtraResidual> extra_residuals;

  int NumVariableNodes() const;
};

// Returns the batch problem: every node, and the camera if there is one.
ProblemConfig FullConfig(int num_nodes, bool has_camera);

// Returns Level I (Eq. 14): the PR nodes, `rings` rings of PI nodes around them, and the camera may
// move.
ProblemConfig LevelOneConfig(const DeformationGraph& graph,
                             const std::vector<char>& point_relevant,
                             bool has_camera,
                             BoundaryEdges boundary_edges,
                             int rings);

// Returns Level II (Eq. 15): only the PI nodes may move; PR nodes and the camera are held constant.
ProblemConfig LevelTwoConfig(const std::vector<char>& point_relevant);

}  // namespace ceres_ed

#endif  // CERES_ED_PROBLEM_PROBLEM_CONFIG_H_
