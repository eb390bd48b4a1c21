// The table of strategies: one row for each SolveMode.
#ifndef CERES_ED_SOLVER_STRATEGIES_STRATEGY_TABLE_H_
#define CERES_ED_SOLVER_STRATEGIES_STRATEGY_TABLE_H_

#include <ceres_ed/solver/decoupling/decoupling.h>
#include <ceres_ed/solver/solver_types.h>

namespace ceres_ed {

// How nodes without observations follow the others.
enum class HiddenNodes {
  // Level I moves all of them.
  kMoveAlong,
  // Level I holds them, and Level II moves them afterwards (Eq. 15).
  kFollow,
  // They are eliminated from Level I. Nodes out of its reach follow by Level II.
  kAreEliminated,
};

// One strategy: its mode, and how it chooses nodes.
struct StrategyInfo {
  SolveMode mode = SolveMode::kBatch;
  HiddenNodes hidden = HiddenNodes::kMoveAlong;
  // Fills in an empty Decoupling. Both of its sets must be in ascending order.
  void (*choose)(const DecouplingInputs& inputs, Decoupling* nodes) = nullptr;
};

// Returns the row of a mode.
const StrategyInfo& FindStrategy(SolveMode mode);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGIES_STRATEGY_TABLE_H_
