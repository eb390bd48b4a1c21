#include "ceres_ed/slam/map/tissue_memory.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/map_edits.h>

namespace ceres_ed {
namespace {

constexpr int kNodes = 60;

// Tissue that breathes: every node oscillates along its own direction, all with one phase.
Eigen::Vector3d Breath(int node, double phase) {
  return std::sin(phase) * Eigen::Vector3d(0.4, 0.3 * std::cos(node), 0.5 * std::sin(0.7 * node));
}

DeformableMap Row() {
  DeformableMap map;
  for (int j = 0; j < kNodes; ++j) {
    // The nodes are not on a line, so that a rotation is determined.
    const Eigen::Vector3d g(j, 3.0 * (j % 3), 2.0 * (j % 5));
    map.AddNode(g, g, Eigen::Matrix3d::Identity());
  }
  return map;
}

void SetTo(double phase, const Eigen::Vector3d& drift, DeformableMap* map) {
  for (int j = 0; j < kNodes; ++j) {
    SetTranslation(map, j, Breath(j, phase) + drift);
  }
}

// Returns the first `count` nodes.
NodeSet First(int count) {
  NodeSet observed;
  for (int j = 0; j < count; ++j) observed.Add(j);
  return observed;
}

// Returns the prior of every node in a frame that sees the first `count` nodes.
std::vector<Eigen::Vector3d> Recall(int count, TissueMemory* memory, DeformableMap* map) {
  memory->BeginFrame(First(count), map);
  memory->Look(First(count), *map);
  memory->UpdatePriors(First(kNodes).nodes(), map);
  std::vector<Eigen::Vector3d> recalled;
  for (int j = 0; j < kNodes; ++j) recalled.push_back(map->node_prior(j));
  return recalled;
}

double Phase(int frame) { return 2.0 * M_PI * frame / 24.0; }

// Returns the memory of one breath with everything in view.
TissueMemory MemoryOfOneBreath(DeformableMap* map, const TissueMemoryOptions& options = {}) {
  TissueMemory memory(options);
  for (int frame = 0; frame < 24; ++frame) {
    SetTo(Phase(frame), Eigen::Vector3d::Zero(), map);
    memory.Keep(First(kNodes), *map);
  }
  return memory;
}

TEST(TissueMemory, RecallsTheHiddenAtTheSamePhase) {
  DeformableMap map = Row();
  TissueMemory memory = MemoryOfOneBreath(&map);
  for (const int frame : {25, 30, 36, 43}) {
    SetTo(Phase(frame), Eigen::Vector3d::Zero(), &map);
    const std::vector<Eigen::Vector3d> recalled = Recall(40, &memory, &map);
    for (int j = 40; j < kNodes; ++j) {
      // A neighbouring frame differs by up to 0.07 and has the likeness exp(-0.5).
      EXPECT_LT((recalled[j] - Breath(j, Phase(frame))).norm(), 0.05) << frame << " " << j;
    }
  }
}

TEST(TissueMemory, LeavesTheObservedWhereTheyAre) {
  DeformableMap map = Row();
  TissueMemory memory = MemoryOfOneBreath(&map);
  SetTo(0.3, {0.1, 0.2, 0.3}, &map);
  const std::vector<Eigen::Vector3d> recalled = Recall(40, &memory, &map);
  for (int j = 0; j < 40; ++j) {
    EXPECT_EQ(recalled[j], Breath(j, 0.3) + Eigen::Vector3d(0.1, 0.2, 0.3));
  }
}

// The gauge: a common motion of all nodes is compensated by the camera.
TEST(TissueMemory, CarriesACommonMotionOn) {
  DeformableMap map = Row();
  TissueMemory memory = MemoryOfOneBreath(&map);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()));
  const Eigen::Vector3d shift(1.0, -2.0, 0.5);
  SetTo(Phase(6), Eigen::Vector3d::Zero(), &map);
  const std::vector<Eigen::Vector3d> still = Recall(40, &memory, &map);
  for (int j = 0; j < kNodes; ++j) {
    const Eigen::Vector3d moved = turn * map.NodePosition(j) + shift;
    SetTranslation(&map, j, moved - map.graph().position(j));
  }
  const std::vector<Eigen::Vector3d> carried = Recall(40, &memory, &map);
  for (int j = 40; j < kNodes; ++j) {
    const Eigen::Vector3d g = map.graph().position(j);
    EXPECT_LT((g + carried[j] - (turn * (g + still[j]) + shift)).norm(), 1e-9);
  }
}

TEST(TissueMemory, GivesTheMeanWhereNothingInViewWasKept) {
  DeformableMap map = Row();
  TissueMemory memory({});
  for (const double phase : {0.2, 0.6, 1.0}) {
    SetTo(phase, Eigen::Vector3d::Zero(), &map);
    // Only the last nodes, which are hidden later.
    NodeSet observed;
    observed.Add(kNodes - 1);
    memory.Keep(observed, map);
  }
  const std::vector<Eigen::Vector3d> recalled = Recall(40, &memory, &map);
  const Eigen::Vector3d mean =
      (Breath(kNodes - 1, 0.2) + Breath(kNodes - 1, 0.6) + Breath(kNodes - 1, 1.0)) / 3.0;
  EXPECT_LT((recalled[kNodes - 1] - mean).norm(), 1e-12);
  // The node was never seen, so its present position is used.
  EXPECT_EQ(recalled[50], Breath(50, 1.0));
}

TEST(TissueMemory, ForgetsEverySecondMomentAndRecallsStill) {
  DeformableMap map = Row();
  TissueMemoryOptions few;
  few.max_moments = 12;
  TissueMemory memory = MemoryOfOneBreath(&map, few);
  for (const int frame : {26, 36, 42}) {
    SetTo(Phase(frame), Eigen::Vector3d::Zero(), &map);
    const std::vector<Eigen::Vector3d> recalled = Recall(40, &memory, &map);
    // The stored moments are twice as far apart.
    EXPECT_LT((recalled[kNodes - 1] - Breath(kNodes - 1, Phase(frame))).norm(), 0.1) << frame;
  }
}

// Each node is recalled from its own moments, whatever was stored of its neighbours.
TEST(TissueMemory, TellsNodesApartThatAreSeenInTurn) {
  DeformableMap map = Row();
  TissueMemory memory({});
  for (int frame = 0; frame < 6; ++frame) {
    SetTo(0.2 * frame, Eigen::Vector3d::Zero(), &map);
    NodeSet observed;
    // Not in ascending order.
    for (int j = kNodes - 1; j >= 40; --j) {
      if (j % 3 == frame % 3) observed.Add(j);
    }
    memory.Keep(observed, map);
  }
  // No stored moment is similar, so the result is the mean.
  const std::vector<Eigen::Vector3d> recalled = Recall(40, &memory, &map);
  for (int j = 40; j < kNodes; ++j) {
    const Eigen::Vector3d mean = 0.5 * (Breath(j, 0.2 * (j % 3)) + Breath(j, 0.2 * (j % 3 + 3)));
    EXPECT_LT((recalled[j] - mean).norm(), 3e-5) << j;
  }
}

TEST(TissueMemory, AffectsTheHiddenNodesOfMomentsThatShareNodesWithTheView) {
  DeformableMap map = Row();
  TissueMemory memory({});
  const auto keep = [&](int first, int last) {
    NodeSet observed;
    for (int j = first; j < last; ++j) observed.Add(j);
    memory.Keep(observed, map);
  };
  keep(35, 45);
  keep(38, 42);
  keep(30, 37);
  // This moment has no node in common with the present.
  keep(50, 55);
  memory.BeginFrame(First(40), &map);
  memory.Look(First(40), map);
  EXPECT_EQ(memory.Affected(), (std::vector<int>{40, 41, 42, 43, 44}));
}

// The steps are fractions of the box that the nodes of a moment span.
TEST(TissueMemory, KeepsTranslationsToAShareOfTheirSpread) {
  DeformableMap map = Row();
  TissueMemory memory({});
  const double spread = 40.0;
  for (int j = 0; j < kNodes; ++j) {
    SetTranslation(
        &map,
        j,
        spread * Eigen::Vector3d(std::sin(j), std::cos(j), 0.0) + Eigen::Vector3d(1e4, -1e4, 0.7));
  }
  memory.Keep(First(kNodes), map);
  for (int j = 40; j < kNodes; ++j) SetTranslation(&map, j, Eigen::Vector3d::Zero());
  const std::vector<Eigen::Vector3d> recalled = Recall(40, &memory, &map);
  for (int j = 40; j < kNodes; ++j) {
    const Eigen::Vector3d was =
        spread * Eigen::Vector3d(std::sin(j), std::cos(j), 0.0) + Eigen::Vector3d(1e4, -1e4, 0.7);
    EXPECT_LT((recalled[j] - was).norm(), 2.0 * spread / 65535.0) << j;
  }
}

TEST(TissueMemory, HoldsSixBytesANodeOfAMoment) {
  DeformableMap map = Row();
  TissueMemoryOptions options;
  options.max_moments = 1000;
  TissueMemory memory(options);
  for (int frame = 0; frame < 500; ++frame) memory.Keep(First(kNodes), map);
  // The memory that a moment needs in addition.
  EXPECT_LT(memory.HeapBytes(), 500u * (6 * kNodes + 400) + 2000);
  EXPECT_GT(memory.HeapBytes(), 500u * 6 * kNodes);
}

}  // namespace
}  // namespace ceres_ed
