// The two steps of the paper: camera and PR nodes (Eq. 14), then the PI nodes (Eq. 15).
#ifndef CERES_ED_SOLVER_STRATEGIES_TWO_LEVEL_H_
#define CERES_ED_SOLVER_STRATEGIES_TWO_LEVEL_H_

#include <ceres_ed/graph/node_neighborhood.h>
#include <ceres_ed/solver/decoupling/decoupling.h>

namespace ceres_ed {

// Level I moves the PR nodes and some rings of PI nodes around them, and holds the rest.
inline void ChooseTwoLevel(const DecouplingInputs& inputs, Decoupling* nodes) {
  for (const int node : inputs.point_relevant->nodes()) nodes->moved.Add(node);
  AddRings(
      *inputs.graph, inputs.options->rings, [](int) { return true; }, &nodes->moved);
  nodes->moved.Sort();
  nodes->boundary_edges = inputs.options->boundary_edges;
}

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGIES_TWO_LEVEL_H_
