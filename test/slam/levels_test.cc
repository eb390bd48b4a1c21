#include "ceres_ed/slam/levels/levels.h"

#include <ceres_ed/graph/node_neighborhood.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/slam/level_scenes.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

bool SameNode(const DeformationState& a, const DeformationState& b, int node) {
  return std::equal(a.node(node), a.node(node) + kNodeSize, b.node(node));
}

bool SameCamera(const DeformationState& a, const DeformationState& b) {
  return a.camera_from_map.rotation.coeffs() == b.camera_from_map.rotation.coeffs() &&
         a.camera_from_map.translation == b.camera_from_map.translation;
}

// Solves Level I over the whole graph, as one problem in which the other nodes are constant.
LevelSummary SolveWholeLevelOne(const LevelScene& scene,
                                const LevelsOptions& options,
                                LinearSolver linear_solver,
                                DeformationState* state) {
  const auto builder = scene.WholeProblem(options);
  const ProblemConfig config = LevelOneConfig(scene.map.graph(),
                                              builder->PointRelevantNodes(),
                                              /*has_camera=*/true,
                                              options.strategy.boundary_edges,
                                              options.strategy.rings);
  SolveSummary summary;
  EXPECT_TRUE(
      MakeLevelSolver(linear_solver)->Solve(*builder, config, options.solver, state, &summary));
  return summary.levels.back();
}

TEST(Levels, LevelOneEqualsThatOfTheWholeGraph) {
  for (const BoundaryEdges boundary : {BoundaryEdges::kKeep, BoundaryEdges::kCut}) {
    for (const int rings : {0, 2}) {
      LevelScene scene;
      const LevelsOptions options = ThreeSteps(rings, boundary);
      DeformationState expected = scene.map.state();
      const LevelSummary whole =
          SolveWholeLevelOne(scene, options, LinearSolver::kBlock, &expected);
      const DeformationState before = scene.map.state();
      const LevelReport report =
          MakeLevels(options)->SolveLevelOne(scene.observations, nullptr, &scene.map);
      EXPECT_NE(report.status, SolveStatus::kFailed);
      EXPECT_EQ(report.point_relevant, 16);
      EXPECT_EQ(report.variable_nodes, whole.num_variable_nodes);
      EXPECT_EQ(report.variable_nodes, 4 * (4 + rings));
      EXPECT_GT(report.iterations, 1);
      EXPECT_NEAR(report.energy, whole.final_cost, 1e-9 * whole.final_cost);
      EXPECT_LT(LargestDifference(scene.map.state(), expected), 1e-9) << rings;
      EXPECT_GT(LargestDifference(scene.map.state(), before), 1e-3);
    }
  }
}

// Ceres reaches the same minimum by other steps, up to the square root of the rounding error of the
// energy.
// What a bound that nothing exceeds releases is nothing.
TEST(Levels, ByInformationWithoutABoundEqualNoRings) {
  LevelScene scene;
  LevelScene other;
  LevelsOptions options = ThreeSteps(0, BoundaryEdges::kKeep);
  MakeLevels(options)->SolveLevelOne(scene.observations, nullptr, &scene.map);
  options.strategy.active = ActiveSetRule::kInformation;
  options.strategy.active_bound = std::numeric_limits<double>::infinity();
  const auto levels = MakeLevels(options);
  levels->BeginFrame();
  const LevelReport report = levels->SolveLevelOne(other.observations, nullptr, &other.map);
  EXPECT_EQ(report.variable_nodes, 16);
  EXPECT_GT(report.held_share, 0.0);
  // The window is larger, so sums have another order.
  EXPECT_LT(LargestDifference(scene.map.state(), other.map.state()), 1e-14);
}

// The set reaches the last node within some solves of a frame. Where it ends, batch stays.
TEST(Levels, ByInformationWithABoundOfZeroEqualBatch) {
  LevelScene scene;
  LevelsOptions options = ExactLevels(0, BoundaryEdges::kKeep);
  LevelsOptions batch = options;
  batch.strategy.mode = SolveMode::kBatch;
  options.strategy.active = ActiveSetRule::kInformation;
  options.strategy.active_bound = 0.0;
  const auto levels = MakeLevels(options);
  levels->BeginFrame();
  LevelReport report;
  for (int k = 0; k < 8 && report.variable_nodes < 14 * 4; ++k) {
    report = levels->SolveLevelOne(scene.observations, nullptr, &scene.map);
  }
  EXPECT_EQ(report.variable_nodes, 14 * 4);
  const DeformationState found = scene.map.state();
  const double energy =
      MakeLevels(batch)->SolveLevelOne(scene.observations, nullptr, &scene.map).energy;
  EXPECT_NEAR(report.energy, energy, 1e-10 * energy);
  EXPECT_LT(LargestDifference(scene.map.state(), found), 1e-6);
}

TEST(Levels, LevelOneEndsWhereCeresDoes) {
  LevelScene scene;
  const LevelsOptions options = ExactLevels(2, BoundaryEdges::kKeep);
  DeformationState expected = scene.map.state();
  const LevelSummary whole = SolveWholeLevelOne(scene, options, LinearSolver::kCeres, &expected);
  const LevelReport report =
      MakeLevels(options)->SolveLevelOne(scene.observations, nullptr, &scene.map);
  EXPECT_NEAR(report.energy, whole.final_cost, 1e-12 * whole.final_cost);
  EXPECT_LT(LargestDifference(scene.map.state(), expected), 1e-7);
}

TEST(Levels, BothLevelsEqualTheTwoLevelStrategy) {
  for (const BoundaryEdges boundary : {BoundaryEdges::kKeep, BoundaryEdges::kCut}) {
    for (const int rings : {0, 2}) {
      LevelScene scene;
      LevelsOptions options = ThreeSteps(rings, boundary);
      options.level_two = LevelTwoMode::kFull;
      StrategyOptions strategy;
      strategy.mode = SolveMode::kTwoLevel;
      strategy.rings = rings;
      strategy.boundary_edges = boundary;
      const auto builder = scene.WholeProblem(options);
      DeformationState expected = scene.map.state();
      const SolveSummary summary =
          MakeStrategy(strategy)->Solve(*builder, options.solver, &expected);
      ASSERT_EQ(summary.levels.size(), 2u);
      const auto levels = MakeLevels(options);
      const LevelReport one = levels->SolveLevelOne(scene.observations, nullptr, &scene.map);
      const LevelReport two = levels->SolveLevelTwo(nullptr, &scene.map);
      EXPECT_NEAR(one.energy, summary.levels[0].final_cost, 1e-9 * one.energy);
      EXPECT_NEAR(two.energy, summary.levels[1].final_cost, 1e-9 * two.energy);
      EXPECT_EQ(two.variable_nodes, 14 * 4 - 16);
      EXPECT_LT(LargestDifference(scene.map.state(), expected), 1e-9) << rings;
    }
  }
}

TEST(Levels, OfBatchEqualTheBatchStrategy) {
  LevelScene scene;
  LevelsOptions options = ThreeSteps(2, BoundaryEdges::kKeep);
  options.strategy.mode = SolveMode::kBatch;
  const auto builder = scene.WholeProblem(options);
  DeformationState expected = scene.map.state();
  const SolveSummary summary =
      MakeStrategy(StrategyOptions())->Solve(*builder, options.solver, &expected);
  const LevelReport report =
      MakeLevels(options)->SolveLevelOne(scene.observations, nullptr, &scene.map);
  EXPECT_EQ(report.variable_nodes, 14 * 4);
  EXPECT_NEAR(report.energy, summary.final_energy, 1e-9 * report.energy);
  EXPECT_LT(LargestDifference(scene.map.state(), expected), 1e-9);
}

// The width of the levels' own plane loss follows the spread of the distances, whereas a user's
// energy of the same name keeps the width that the user has set.
TEST(Levels, KeepTheWidthOfAUsersLoss) {
  LevelScene scene;
  LevelsOptions options = ThreeSteps(2, BoundaryEdges::kKeep);
  const LossSpec loss = {LossType::kTukey, 0.05};
  const auto builder = scene.WholeProblem(options);
  EnergyRegistry registry;
  RegisterBuiltinEnergies(&registry);
  const auto energy = registry.Create("point_to_plane", {});
  ASSERT_TRUE(energy.ok());
  const int term = builder->AddTerm(
      "users", EnergyKind::kObservation, 0.7 * 16.0 / scene.problem.correspondences.size(), loss);
  EnergyContext context = scene.problem.Context();
  context.graph = &scene.map.graph();
  builder->CollectResiduals(term, **energy, context);
  const double expected = builder->Evaluate(scene.map.state()).terms[term].weighted;
  DeformableMap copy = scene.map;
  const double without =
      MakeLevels(options)->SolveLevelOne(scene.observations, nullptr, &copy).initial_energy;
  options.energies = {{"point_to_plane", 0.7, loss, {}}};
  const double with =
      MakeLevels(options)->SolveLevelOne(scene.observations, nullptr, &scene.map).initial_energy;
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(with - without, expected, 1e-9 * with);
}

TEST(Levels, LeaveHeldNodesAsTheyAreToTheBit) {
  for (const BoundaryEdges boundary : {BoundaryEdges::kKeep, BoundaryEdges::kCut}) {
    LevelScene scene;
    LevelsOptions options;
    options.strategy.rings = 1;
    options.strategy.boundary_edges = boundary;
    options.level_two = LevelTwoMode::kFull;
    const auto levels = MakeLevels(options);
    const DeformationState start = scene.map.state();
    levels->SolveLevelOne(scene.observations, nullptr, &scene.map);
    const DeformationState after_one = scene.map.state();
    // The nodes of the first four columns see points; one more ring moves.
    for (int j = 0; j < 14 * 4; ++j) {
      EXPECT_EQ(levels->point_relevant().Has(j), j < 16) << j;
      EXPECT_EQ(levels->moved_nodes().Has(j), j < 20) << j;
      EXPECT_EQ(SameNode(start, after_one, j), j >= 20) << j;
    }
    EXPECT_FALSE(SameCamera(start, after_one));
    levels->SolveLevelTwo(nullptr, &scene.map);
    for (int j = 0; j < 14 * 4; ++j) {
      EXPECT_EQ(SameNode(after_one, scene.map.state(), j), j < 16) << j;
    }
    EXPECT_TRUE(SameCamera(after_one, scene.map.state()));
  }
}

TEST(Levels, HoldTheCameraWhereItIsGiven) {
  LevelScene scene;
  LevelsOptions options;
  options.camera_variable = false;
  const DeformationState start = scene.map.state();
  MakeLevels(options)->SolveLevelOne(scene.observations, nullptr, &scene.map);
  EXPECT_TRUE(SameCamera(start, scene.map.state()));
  EXPECT_GT(LargestDifference(start, scene.map.state()), 1e-3);
}

TEST(Levels, MoveNothingWhenTheyFail) {
  LevelScene scene;
  const DeformationState start = scene.map.state();
  scene.observations.planes[7].target.y() = std::numeric_limits<double>::quiet_NaN();
  const auto levels = MakeLevels(LevelsOptions());
  const LevelReport report = levels->SolveLevelOne(scene.observations, nullptr, &scene.map);
  EXPECT_EQ(report.status, SolveStatus::kFailed);
  EXPECT_EQ(report.variable_nodes, 0);
  EXPECT_EQ(LargestDifference(start, scene.map.state()), 0.0);
  EXPECT_TRUE(SameCamera(start, scene.map.state()));
  // The next frame is not affected.
  LevelScene fresh;
  LevelScene control;
  levels->SolveLevelOne(fresh.observations, nullptr, &fresh.map);
  MakeLevels(LevelsOptions())->SolveLevelOne(control.observations, nullptr, &control.map);
  EXPECT_LT(LargestDifference(fresh.map.state(), control.map.state()), 1e-12);
}

TEST(Levels, HaveNothingToDoInLevelTwoWhenAllIsSeen) {
  LevelScene scene;
  const auto levels = MakeLevels(LevelsOptions());
  std::vector<Correspondence> all;
  for (int p = 0; p < static_cast<int>(scene.problem.points.size()); ++p) {
    all.push_back({p, /*detail=*/-1, scene.problem.points[p], Eigen::Vector3d::UnitZ(), 1.0});
  }
  scene.observations.planes = scene.Take(all);
  EXPECT_EQ(levels->SolveLevelOne(scene.observations, nullptr, &scene.map).point_relevant, 14 * 4);
  const DeformationState after_one = scene.map.state();
  EXPECT_EQ(levels->SolveLevelTwo(nullptr, &scene.map).variable_nodes, 0);
  EXPECT_EQ(LargestDifference(after_one, scene.map.state()), 0.0);
}

// A long strip whose visible end moves up and down: tests which nodes lazy Level II leaves for
// later, and how they follow on request.
class LazyLevelTwoTest : public ::testing::Test {
 protected:
  static LevelsOptions Options(LevelTwoMode mode) {
    LevelsOptions options;
    options.strategy.rings = 1;
    options.level_two = mode;
    // A larger prior would leave a wave nothing to move.
    options.node_prior_weight = 0.002;
    return options;
  }

  // Returns the targets of frame k.
  FrameObservations Observations(int k) const {
    FrameObservations observations = scene_.observations;
    for (auto* list : {&observations.planes, &observations.features}) {
      for (MapObservation& o : *list) o.target.z() += 0.15 * std::sin(0.9 * k);
    }
    return observations;
  }

  // Returns the number of nodes that Level II has moved.
  int RunFrames(int count, Levels* levels, DeformableMap* map) const {
    int moved = 0;
    for (int k = 1; k <= count; ++k) {
      levels->SolveLevelOne(Observations(k), nullptr, map);
      moved += levels->SolveLevelTwo(nullptr, map).variable_nodes;
    }
    return moved;
  }

  static double LargestDistance(const DeformableMap& a, const DeformableMap& b) {
    double largest = 0.0;
    for (int j = 0; j < a.graph().num_nodes(); ++j) {
      largest = std::max(largest, (a.NodePosition(j) - b.NodePosition(j)).norm());
    }
    return largest;
  }

  LevelScene scene_{60};
};

TEST_F(LazyLevelTwoTest, CatchesUpWithFullLevelTwo) {
  const LevelsOptions options = Options(LevelTwoMode::kLazy);
  const auto levels = MakeLevels(options);
  DeformableMap map = scene_.map;
  RunFrames(6, levels.get(), &map);
  // From the same state, all PI nodes are solved together until they converge.
  DeformableMap settled = map;
  const auto full = MakeLevels(Options(LevelTwoMode::kFull));
  DeformableMap unused = map;
  full->SolveLevelOne(Observations(6), nullptr, &unused);
  for (int k = 0; k < 30; ++k) full->SolveLevelTwo(nullptr, &settled);
  const double left_behind = LargestDistance(map, settled);
  levels->CatchUp(nullptr, &map);
  const double caught_up = LargestDistance(map, settled);
  // The tolerance is the possible error of a node for each of its neighbours.
  EXPECT_GT(left_behind, 2.0 * options.lazy.tolerance);
  EXPECT_LT(caught_up, 2.0 * options.lazy.tolerance);
  EXPECT_TRUE(levels->pending().Unsettled().empty() ||
              levels->point_relevant().Has(levels->pending().Unsettled()[0]));
}

TEST_F(LazyLevelTwoTest, MovesWhatHasReasonToMoveAndLeavesTheRest) {
  const auto lazy = MakeLevels(Options(LevelTwoMode::kLazy));
  const auto full = MakeLevels(Options(LevelTwoMode::kFull));
  DeformableMap map = scene_.map;
  DeformableMap other = scene_.map;
  // The map is at rest before the frames, because the scene starts with a random deformation.
  for (DeformableMap* m : {&map, &other}) {
    full->SolveLevelOne(Observations(0), nullptr, m);
    for (int k = 0; k < 30; ++k) full->SolveLevelTwo(nullptr, m);
  }
  const DeformationState before = map.state();
  const int lazy_moved = RunFrames(1, lazy.get(), &map);
  const int full_moved = RunFrames(1, full.get(), &other);
  EXPECT_GT(lazy_moved, 0);
  EXPECT_LT(lazy_moved, full_moved / 4);
  // The far end has not changed.
  for (int j = 30 * 4; j < 60 * 4; ++j) EXPECT_TRUE(SameNode(before, map.state(), j)) << j;
}

TEST_F(LazyLevelTwoTest, WorksAsMuchOnALongerMap) {
  const LevelScene longer(240);
  const auto on_short = MakeLevels(Options(LevelTwoMode::kLazy));
  const auto on_long = MakeLevels(Options(LevelTwoMode::kLazy));
  DeformableMap short_map = scene_.map;
  DeformableMap long_map = longer.map;
  const int moved = RunFrames(3, on_short.get(), &short_map);
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, 3 * 60 * 4 / 2);
  EXPECT_EQ(RunFrames(3, on_long.get(), &long_map), moved);
}

TEST_F(LazyLevelTwoTest, CatchesUpWhereItIsAsked) {
  const auto levels = MakeLevels(Options(LevelTwoMode::kLazy));
  DeformableMap map = scene_.map;
  RunFrames(3, levels.get(), &map);
  std::vector<int> unsettled = levels->pending().Unsettled();
  unsettled.erase(std::remove_if(unsettled.begin(),
                                 unsettled.end(),
                                 [&](int node) { return levels->point_relevant().Has(node); }),
                  unsettled.end());
  ASSERT_FALSE(unsettled.empty());
  const int wanted = unsettled.back();
  levels->CatchUp({wanted}, nullptr, &map);
  EXPECT_LE(levels->pending().change(wanted), levels->pending().tolerance());
}

TEST_F(LazyLevelTwoTest, CatchesUpOnACopyWithoutAnEffect) {
  const auto levels = MakeLevels(Options(LevelTwoMode::kLazy));
  const auto control = MakeLevels(Options(LevelTwoMode::kLazy));
  DeformableMap map = scene_.map;
  DeformableMap expected = scene_.map;
  RunFrames(3, levels.get(), &map);
  RunFrames(3, control.get(), &expected);
  DeformableMap copy = map;
  levels->CatchUpCopy(nullptr, &copy);
  EXPECT_GT(LargestDistance(copy, map), 0.0);
  RunFrames(2, levels.get(), &map);
  RunFrames(2, control.get(), &expected);
  EXPECT_EQ(LargestDifference(map.state(), expected.state()), 0.0);
}

TEST(Levels, CountDataPerNodeWhateverTheirNumber) {
  LevelScene once;
  LevelScene twice;
  auto& planes = twice.observations.planes;
  auto& features = twice.observations.features;
  planes.insert(planes.end(), once.observations.planes.begin(), once.observations.planes.end());
  features.insert(
      features.end(), once.observations.features.begin(), once.observations.features.end());
  const LevelsOptions options = ThreeSteps(2, BoundaryEdges::kKeep);
  const LevelReport a = MakeLevels(options)->SolveLevelOne(once.observations, nullptr, &once.map);
  const LevelReport b = MakeLevels(options)->SolveLevelOne(twice.observations, nullptr, &twice.map);
  EXPECT_NEAR(a.energy, b.energy, 1e-9 * a.energy);
  EXPECT_LT(LargestDifference(once.map.state(), twice.map.state()), 1e-9);
}

TEST(Levels, HoldNodesByTheShareOfTheFrame) {
  LevelScene shared;
  shared.observations.node_prior_share = 0.25;
  LevelScene weak;
  const LevelsOptions options = ThreeSteps(2, BoundaryEdges::kKeep);
  LevelsOptions weak_options = options;
  weak_options.node_prior_weight *= 0.25;
  MakeLevels(options)->SolveLevelOne(shared.observations, nullptr, &shared.map);
  MakeLevels(weak_options)->SolveLevelOne(weak.observations, nullptr, &weak.map);
  EXPECT_LT(LargestDifference(shared.map.state(), weak.map.state()), 1e-12);
  LevelScene whole;
  MakeLevels(options)->SolveLevelOne(whole.observations, nullptr, &whole.map);
  EXPECT_GT(LargestDifference(shared.map.state(), whole.map.state()), 1e-4);
}

TEST(Levels, TakeMoreEnergiesByName) {
  const EnergyRegistry registry = BuiltinEnergies();
  LevelsOptions options;
  options.energies = {{"rotaton", 1.0, {}, {}}};
  EXPECT_THAT(Levels::Create(options, registry).status().message(), HasSubstr("rotaton"));
  options.energies = {{"rotation", 1.0, {}, {{"gain", 1.0}}}};
  EXPECT_THAT(Levels::Create(options, registry).status().message(), HasSubstr("gain"));
  // A second rotation term has the same effect as a larger weight of the first.
  LevelScene more;
  LevelScene heavier;
  LevelsOptions exact = ThreeSteps(2, BoundaryEdges::kKeep);
  exact.energies = {{"rotation", 0.3, {}, {}}};
  MakeLevels(exact)->SolveLevelOne(more.observations, nullptr, &more.map);
  exact.energies.clear();
  exact.rotation_weight += 0.3;
  MakeLevels(exact)->SolveLevelOne(heavier.observations, nullptr, &heavier.map);
  EXPECT_LT(LargestDifference(more.map.state(), heavier.map.state()), 1e-9);
}

}  // namespace
}  // namespace ceres_ed
