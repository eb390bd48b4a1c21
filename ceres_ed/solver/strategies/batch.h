// The batch strategy: Level I moves every node. It is the reference for the other strategies.
#ifndef CERES_ED_SOLVER_STRATEGIES_BATCH_H_
#define CERES_ED_SOLVER_STRATEGIES_BATCH_H_

#include <ceres_ed/solver/decoupling/decoupling.h>

namespace ceres_ed {

// Chooses all nodes.
inline void ChooseBatch(const DecouplingInputs& inputs, Decoupling* nodes) {
  for (int j = 0; j < inputs.graph->num_nodes(); ++j) nodes->moved.Add(j);
}

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGIES_BATCH_H_
