#include "ceres_ed/slam/levels/edge_weights.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/simulation/texture.h>
#include <ceres_ed/slam/slam.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>

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

// A fold of tissue that is pulled over the tissue behind it.
struct FoldScene {
  static constexpr double kBehind = 0.1;
  static constexpr double kFold = 0.093;
  // Metres per frame.
  static constexpr double kStep = 0.0005;

  PinholeCamera camera{240.0, 240.0, 159.5, 119.5, 320, 240};
  SyntheticTexture behind{3};
  SyntheticTexture fold{4};

  // The place at rest, in the frame of the first frame, of what pixel (u, v) shows.
  static bool IsFold(const Eigen::Vector3d& place) {
    return std::abs(place.x() + 0.012) < 0.02 && std::abs(place.y()) < 0.022;
  }

  void Render(int frame, DepthImage* depth, ColorImage* color) const {
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        Eigen::Vector3d place = camera.BackProject(u, v, kFold);
        place.x() -= kStep * frame;
        const bool is_fold = IsFold(place);
        if (!is_fold) place = camera.BackProject(u, v, kBehind);
        (*depth)(u, v) = static_cast<float>(place.z());
        const Eigen::Vector3d shade = (is_fold ? fold : behind).Color(place, place.z() / camera.fx);
        for (int c = 0; c < 3; ++c) {
          (*color)(u, v)[c] =
              static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(shade[c], 0.0, 1.0)));
        }
      }
    }
  }
};

// Returns how far the points of the fold that were seen in the first frame are from their places at
// the end, in the mean, in metres.
double LagOfFold(double yield_strain) {
  constexpr int kFrames = 30;
  const FoldScene scene;
  const EnergyRegistry registry = BuiltinEnergies();
  SlamOptions options;
  options.camera = CameraMode::kFixed;
  options.levels.yield_strain = yield_strain;
  StatusOr<std::unique_ptr<DeformableSlam>> slam =
      DeformableSlam::Create(scene.camera, options, registry);
  EXPECT_TRUE(slam.ok());
  DepthImage depth(scene.camera.width, scene.camera.height);
  ColorImage color(scene.camera.width, scene.camera.height);
  for (int k = 0; k < kFrames; ++k) {
    scene.Render(k, &depth, &color);
    SlamFrame frame;
    frame.number = k;
    frame.depth = &depth;
    frame.color = &color;
    (*slam)->Process(frame);
  }
  const DeformableMap& map = (*slam)->map();
  double sum = 0.0;
  int count = 0;
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot)) continue;
    const MapPoint point = map.point(slot);
    const Eigen::Vector3d born = point.birth_position * (*slam)->unit();
    // The border of the fold is uncertain by a cell of the surface.
    if (point.birth_frame != 0 || !FoldScene::IsFold(born + Eigen::Vector3d(0.003, 0.003, 0.0)) ||
        !FoldScene::IsFold(born - Eigen::Vector3d(0.003, 0.003, 0.0)) ||
        born.z() > 0.5 * (FoldScene::kFold + FoldScene::kBehind)) {
      continue;
    }
    const PointBinding binding = map.binding(slot);
    const Eigen::Vector3d now =
        (*slam)->unit() * WarpPoint(map.graph(), map.state(), binding, point.position);
    sum += (now - born - Eigen::Vector3d(FoldScene::kStep * (kFrames - 1), 0.0, 0.0)).norm();
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
