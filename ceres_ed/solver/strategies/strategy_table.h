// The table of strategies: one row for each SolveMode.
#ifndef CERES_ED_SOLVER_STRATEGIES_STRATEGY_TABLE_H_
#define CERES_ED_SOLVER_STRATEGIES_STRATEGY_TABLE_H_

#include <ceres_ed/solver/decoupling/decoupling.h>
#include <ceres_ed/solver/solver_types.h>

namespace ceres_ed {

// How the nodes that nothing observes come to follow the others.
enum class HiddenNodes {
  // Level I moves all of them.
  kMoveAlong,
  // Level I holds them, and Level II moves them afterwards (Eq. 15).
  kFollow,
  // They are eliminated from Level I. Those that are out of reach follow as above.
  kAreEliminated,
};

struct StrategyInfo {
  SolveMode mode = SolveMode::kBatch;
  HiddenNodes hidden = HiddenNodes::kMoveAlong;
  // Fills in an empty Decoupling. Both of its sets become sorted by number.
  void (*choose)(const DecouplingInputs& inputs, Decoupling* nodes) = nullptr;
};

// The row of a mode.
const StrategyInfo& FindStrategy(SolveMode mode);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_STRATEGIES_STRATEGY_TABLE_H_
