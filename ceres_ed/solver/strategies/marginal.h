// Exact marginalisation of the PI nodes (Eq. 18 to 21).
#ifndef CERES_ED_SOLVER_STRATEGIES_MARGINAL_H_
#define CERES_ED_SOLVER_STRATEGIES_MARGINAL_H_

#include <ceres_ed/graph/node_neighborhood.h>
#include <ceres_ed/solver/decoupling/decoupling.h>

#include <vector>

namespace ceres_ed {

// Level I moves the PR nodes and some rings of PI nodes around them. Nodes within the reach of
// these nodes are eliminated, and nodes beyond it are held.
inline void ChooseMarginal(const DecouplingInputs& inputs, Decoupling* nodes) {
  const auto all = [](int) { return true; };
  for (const int node : inputs.point_relevant->nodes()) nodes->moved.Add(node);
  AddRings(*inputs.graph, inputs.options->rings, all, &nodes->moved);
  nodes->moved.Sort();
  NodeSet reached;
  for (const int node : nodes->moved.nodes()) reached.Add(node);
  if (inputs.options->marginal_reach < 0) {
    for (int j = 0; j < inputs.graph->num_nodes(); ++j) reached.Add(j);
  } else {
    AddRings(*inputs.graph, inputs.options->marginal_reach, all, &reached);
  }
  for (const int node : reached.nodes()) {
    if (!nodes->moved.Has(node)) nodes->eliminated.Add(node);
  }
  nodes->eliminated.Sort();
}

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGIES_MARGINAL_H_
