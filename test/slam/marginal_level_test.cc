#include "ceres_ed/slam/levels/levels.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/level_scenes.h>

namespace ceres_ed {
namespace {

LevelsOptions Marginal(LevelTwoMode level_two) {
  LevelsOptions options;
  options.strategy.mode = SolveMode::kMarginal;
  options.strategy.rings = 0;
  options.level_two = level_two;
  return options;
}

TEST(MarginalLevels, TakeTheBatchStep) {
  LevelScene scene;
  LevelsOptions marginal = Marginal(LevelTwoMode::kFull);
  LevelsOptions batch;
  batch.strategy.mode = SolveMode::kBatch;
  // Both use Gauss-Newton steps, because their damping would differ.
  marginal.solver.initial_trust_region_radius = 1e14;
  batch.solver.initial_trust_region_radius = 1e14;
  DeformableMap expected = scene.map;
  const DeformationState before = scene.map.state();
  const LevelReport whole =
      MakeLevels(batch)->SolveLevelOne(scene.observations, nullptr, &expected);
  const LevelReport report =
      MakeLevels(marginal)->SolveLevelOne(scene.observations, nullptr, &scene.map);
  ASSERT_EQ(whole.iterations, 1);
  EXPECT_EQ(report.point_relevant, 16);
  EXPECT_EQ(report.marginalized, 14 * 4 - 16);
  EXPECT_EQ(report.variable_nodes, 14 * 4);
  EXPECT_NEAR(report.initial_energy, whole.initial_energy, 1e-9 * whole.initial_energy);
  EXPECT_NEAR(report.energy, whole.energy, 1e-9 * whole.energy);
  EXPECT_LT(LargestDifference(scene.map.state(), expected.state()), 1e-9);
  EXPECT_GT(LargestDifference(scene.map.state(), before), 1e-2);
}

TEST(MarginalLevels, ConvergeToTheBatchMinimum) {
  LevelScene scene;
  LevelsOptions batch;
  batch.strategy.mode = SolveMode::kBatch;
  DeformableMap expected = scene.map;
  const auto reference = MakeLevels(batch);
  const auto levels = MakeLevels(Marginal(LevelTwoMode::kFull));
  LevelReport whole;
  LevelReport report;
  // The start is far away: with robust losses more steps are needed than in a frame.
  for (int k = 0; k < 3; ++k) {
    whole = reference->ConvergeLevelOne(scene.observations, nullptr, &expected);
    report = levels->ConvergeLevelOne(scene.observations, nullptr, &scene.map);
  }
  EXPECT_EQ(whole.status, SolveStatus::kConverged);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_NEAR(report.energy, whole.energy, 1e-4 * whole.energy);
}

// Nodes beyond the reach are held, and follow by Level II.
TEST(MarginalLevels, EliminateWithinTheirReach) {
  LevelScene scene(30);
  LevelsOptions options = Marginal(LevelTwoMode::kLazy);
  options.strategy.rings = 1;
  options.strategy.marginal_reach = 3;
  const auto levels = MakeLevels(options);
  const DeformationState before = scene.map.state();
  const LevelReport report = levels->SolveLevelOne(scene.observations, nullptr, &scene.map);
  EXPECT_EQ(report.marginalized, 3 * 4);
  EXPECT_EQ(report.variable_nodes, 8 * 4);
  EXPECT_EQ(levels->moved_nodes().size(), 5 * 4);
  for (int j = 8 * 4; j < 30 * 4; ++j) {
    EXPECT_TRUE(std::equal(before.node(j), before.node(j) + kNodeSize, scene.map.state().node(j)));
  }
  EXPECT_FALSE(levels->pending().Unsettled().empty());
  EXPECT_GT(levels->SolveLevelTwo(nullptr, &scene.map).variable_nodes, 0);
}

TEST(MarginalLevels, UseAnEliminationAgain) {
  LevelScene scene;
  const auto levels = MakeLevels(Marginal(LevelTwoMode::kFull));
  for (int k = 0; k < 2; ++k) {
    levels->ConvergeLevelOne(scene.observations, nullptr, &scene.map);
  }
  const int before = levels->solver().marginalization().num_eliminations();
  EXPECT_GT(before, 0);
  // At the minimum nothing moves, so the next frame needs no new elimination.
  levels->SolveLevelOne(scene.observations, nullptr, &scene.map);
  EXPECT_EQ(levels->solver().marginalization().num_eliminations(), before);
  EXPECT_EQ(levels->solver().num_choices(), 1);
}

}  // namespace
}  // namespace ceres_ed
