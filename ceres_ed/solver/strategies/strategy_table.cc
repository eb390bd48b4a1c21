#include "ceres_ed/solver/strategies/strategy_table.h"

#include <ceres_ed/solver/strategies/batch.h>
#include <ceres_ed/solver/strategies/marginal.h>
#include <ceres_ed/solver/strategies/two_level.h>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr StrategyInfo kStrategies[] = {
    {SolveMode::kBatch, HiddenNodes::kMoveAlong, ChooseBatch},
    {SolveMode::kTwoLevel, HiddenNodes::kFollow, ChooseTwoLevel},
    {SolveMode::kMarginal, HiddenNodes::kAreEliminated, ChooseMarginal}};

}  // namespace

const StrategyInfo& FindStrategy(SolveMode mode) {
  for (const StrategyInfo& strategy : kStrategies) {
    if (strategy.mode == mode) return strategy;
  }
  LOG(FATAL) << "no strategy of mode " << static_cast<int>(mode);
}

}  // namespace ceres_ed
