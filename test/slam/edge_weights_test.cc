#include "ceres_ed/slam/levels/edge_weights.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/slam/slam.h>

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>
#include <test/slam/layer_scene.h>

namespace ceres_ed {
namespace {

TEST(EdgeWeights, FallWithTheStrainOfTheirEdge) {
  DeformableMap map;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  // The second node has moved by 0.3 beside the edge.
  const int a = map.AddNode({0.0, 0.0, 5.0}, {0.0, 0.0, 5.0}, identity);
  const int b = map.AddNode({1.0, 0.0, 5.0}, {1.0, 0.3, 5.0}, identity);
  map.Connect(a, b);
  UpdateEdgeWeights({a}, 0.15, &map);
  for (const GraphEdge& edge : map.graph().edges()) {
    EXPECT_DOUBLE_EQ(edge.weight, edge.from == a ? 1.0 / 25.0 : 1.0);
  }
  UpdateEdgeWeights({a, b}, 0.3, &map);
  for (const GraphEdge& edge : map.graph().edges()) EXPECT_DOUBLE_EQ(edge.weight, 0.25);
}

TEST(EdgeWeights, DoNotFallWhereTheTissueTurnsAndStretches) {
  DeformableMap map;
  Eigen::Matrix3d affine;
  affine << 0.0, -1.2, 0.0, 0.8, 0.0, 0.1, 0.0, 0.0, 1.1;
  const Eigen::Vector3d shift(0.3, -2.0, 0.5);
  const Eigen::Vector3d places[] = {{0.0, 0.0, 5.0}, {1.0, 0.2, 5.0}, {0.3, 0.9, 5.5}};
  for (const Eigen::Vector3d& place : places) map.AddNode(place, affine * place + shift, affine);
  map.Connect(0, 1);
  map.Connect(1, 2);
  UpdateEdgeWeights({0, 1, 2}, 0.15, &map);
  for (const GraphEdge& edge : map.graph().edges()) EXPECT_NEAR(edge.weight, 1.0, 1e-12);
}

// Returns how far the points of a fold, which is pulled over the tissue behind it, are from their
// places at the end, in the mean, in metres.
double LagOfFold(double yield_strain) {
  constexpr int kFrames = 30;
  LayerScene scene;
  scene.layer = 0.093;
  scene.least = {-0.032, -0.022};
  scene.most = {0.008, 0.022};
  scene.step = {0.0005, 0.0};
  SlamOptions options;
  options.camera = CameraMode::kFixed;
  options.levels.yield_strain = yield_strain;
  const std::unique_ptr<DeformableSlam> slam = TrackLayer(scene, options, kFrames);
  const DeformableMap& map = slam->map();
  double sum = 0.0;
  int count = 0;
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot)) continue;
    const MapPoint point = map.point(slot);
    const Eigen::Vector3d born = point.birth_position * slam->unit();
    const bool is_fold = born.z() < 0.5 * (scene.layer + scene.wall);
    // The border of the fold is uncertain by a cell of the surface.
    if (point.birth_frame != 0 || !is_fold || !scene.IsOnLayer(born, 0.003)) continue;
    const PointBinding binding = map.binding(slot);
    Eigen::Vector3d moved =
        slam->unit() * WarpPoint(map.graph(), map.state(), binding, point.position) - born;
    moved.head<2>() -= (kFrames - 1) * scene.step;
    sum += moved.norm();
    ++count;
  }
  EXPECT_GT(count, 50);
  return sum / std::max(1, count);
}

TEST(EdgeWeights, LetAFoldBePulledOverTheTissueBehindIt) {
  const double lag = LagOfFold(LevelsOptions().yield_strain);
  const double stiff = LagOfFold(0.0);
  // The fold has moved by 14.5 mm.
  EXPECT_LT(lag, 0.0015);
  EXPECT_LT(lag, 0.4 * stiff);
}

}  // namespace
}  // namespace ceres_ed
