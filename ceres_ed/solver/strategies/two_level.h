// The two steps of the paper: camera and PR nodes (Eq. 14), then the PI nodes (Eq. 15).
#ifndef CERES_ED_SOLVER_STRATEGIES_TWO_LEVEL_H_
#define CERES_ED_SOLVER_STRATEGIES_TWO_LEVEL_H_

#include <ceres_ed/graph/node_neighborhood.h>
#include <ceres_ed/solver/decoupling/decoupling.h>

namespace ceres_ed {

// The number of rings around the moved nodes that are looked at for nodes to release.
inline constexpr int kCandidateRings = 4;
// The number of rings in which nodes that were not judged are moved: the view moves on by about so
// many rings from one frame to the next.
inline constexpr int kUnjudgedRings = 2;

// Level I moves the PR nodes and some PI nodes around them, and holds the rest. The PI nodes are
// some rings, or those of the active set.
inline void ChooseTwoLevel(const DecouplingInputs& inputs, Decoupling* nodes) {
  const auto all = [](int) { return true; };
  for (const int node : inputs.point_relevant->nodes()) nodes->moved.Add(node);
  nodes->boundary_edges = inputs.options->boundary_edges;
  if (inputs.options->active == ActiveSetRule::kRings) {
    AddRings(*inputs.graph, inputs.options->rings, all, &nodes->moved);
    nodes->moved.Sort();
    return;
  }
  const ActiveSet& active = *inputs.active;
  for (const int node : active.nodes().nodes()) {
    if (node < inputs.graph->num_nodes()) nodes->moved.Add(node);
  }
  if (active.moves_unjudged()) {
    AddRings(
        *inputs.graph,
        kUnjudgedRings,
        [&active](int node) { return !active.IsJudged(node); },
        &nodes->moved);
  }
  nodes->moved.Sort();
  NodeSet reached = nodes->moved;
  AddRings(*inputs.graph, kCandidateRings, all, &reached);
  for (const int node : reached.nodes()) {
    if (!nodes->moved.Has(node)) nodes->candidates.Add(node);
  }
  nodes->candidates.Sort();
}

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGIES_TWO_LEVEL_H_
