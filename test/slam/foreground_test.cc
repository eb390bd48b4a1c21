#include "ceres_ed/slam/frame/foreground.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/slam.h>

#include <algorithm>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>
#include <test/slam/layer_scene.h>

namespace ceres_ed {
namespace {

// Returns the share of the pixels of the layer or the mask that are both.
double MaskAgreement(const LayerScene& scene, int frame, const MaskImage& mask) {
  int both = 0;
  int either = 0;
  for (int v = 0; v < scene.camera.height; ++v) {
    for (int u = 0; u < scene.camera.width; ++u) {
      Eigen::Vector3d place;
      const bool is_layer = scene.ShowsLayer(u, v, frame, &place);
      const bool is_masked = mask(u, v) != 0;
      if (is_layer && is_masked) ++both;
      if (is_layer || is_masked) ++either;
    }
  }
  return either == 0 ? 1.0 : both / static_cast<double>(either);
}

// Expects that no point of the map was born on the layer, and that those of the wall have not moved
// by more than a tenth of a node spacing.
void ExpectOnlyTheWall(const LayerScene& scene, const DeformableSlam& slam) {
  const DeformableMap& map = slam.map();
  int on_layer = 0;
  double moved = 0.0;
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot)) continue;
    const MapPoint point = map.point(slot);
    const Eigen::Vector3d born = point.birth_position * slam.unit();
    if (born.z() < 0.5 * (scene.layer + scene.wall)) ++on_layer;
    const PointBinding binding = map.binding(slot);
    const Eigen::Vector3d now =
        slam.unit() * WarpPoint(map.graph(), map.state(), binding, point.position);
    moved = std::max(moved, (now - born).norm());
  }
  EXPECT_EQ(on_layer, 0);
  EXPECT_LT(moved, 0.1 * slam.unit());
}

SlamOptions StillCamera() {
  SlamOptions options;
  options.camera = CameraMode::kFixed;
  return options;
}

TEST(Foreground, KeepsAToolThatComesInOutOfTheMap) {
  LayerScene scene;
  // The tool is a bar that enters from the left, and comes as near to the tissue as 8 mm.
  scene.layer = 0.092;
  scene.least = {-0.2, -0.008};
  scene.most = {-0.062, 0.008};
  scene.step = {0.003, 0.0};
  int frames_with_tool = 0;
  TrackLayer(
      scene, StillCamera(), 30, [&](int k, const DeformableSlam& slam, const FrameReport& r) {
        ExpectOnlyTheWall(scene, slam);
        // The first cells of the tool are too few to be told.
        if (k < 6) return;
        EXPECT_GT(MaskAgreement(scene, k, slam.ForegroundMask()), 0.8) << k;
        EXPECT_GT(r.foreground, 0.0);
        EXPECT_EQ(r.status, FrameStatus::kTracked);
        ++frames_with_tool;
      });
  EXPECT_EQ(frames_with_tool, 24);
}

TEST(Foreground, IsLoadedAsItWasSaved) {
  LayerScene scene;
  scene.least = {-0.03, 0.0};
  scene.most = {-0.015, 0.2};
  scene.step = {0.0015, 0.0};
  const std::unique_ptr<DeformableSlam> slam = TrackLayer(scene, StillCamera(), 3);
  const MaskImage mask = slam->ForegroundMask();
  ASSERT_GT(std::count(mask.pixels().begin(), mask.pixels().end(), 1), 0);
  CheckpointWriter writer;
  slam->Exchange(&writer);
  const std::string bytes = writer.TakeBytes();
  const auto reader = CheckpointReader::Open(bytes);
  ASSERT_TRUE(reader.ok()) << reader.status().message();
  const std::unique_ptr<DeformableSlam> loaded = TrackLayer(scene, StillCamera(), 0);
  loaded->Exchange(reader->get());
  ASSERT_TRUE((*reader)->status().ok()) << (*reader)->status().message();
  EXPECT_EQ(loaded->ForegroundMask().pixels(), mask.pixels());
}

// The surface has a cell for every few pixels.
TEST(Foreground, SavesNothingOfCellsThatAreTissue) {
  const LayerScene scene;
  ObservedSurfaceOptions options;
  options.cell = 1;
  const DepthImage depth(scene.camera.width, scene.camera.height, 0.1F);
  ObservedSurface surface(depth, scene.camera, 1.0, options);
  ASSERT_GT(surface.num_valid(), 1000);
  Foreground foreground(scene.camera);
  EXPECT_EQ(foreground.Remove({}, CameraPose(), &surface), 0.0);
  CheckpointWriter writer;
  foreground.Exchange(&writer);
  EXPECT_LT(writer.TakeBytes().size(), 1000u);
}

TEST(Foreground, KeepsAToolOfTheFirstFrameOutOfTheMap) {
  LayerScene scene;
  scene.least = {-0.03, 0.0};
  scene.most = {-0.015, 0.2};
  scene.step = {0.0015, 0.0};
  TrackLayer(scene, StillCamera(), 25, [&](int k, const DeformableSlam& slam, const FrameReport&) {
    EXPECT_GT(MaskAgreement(scene, k, slam.ForegroundMask()), 0.8) << k;
    ExpectOnlyTheWall(scene, slam);
  });
}

TEST(Foreground, BecomesAPartOfTheSceneIfItStandsStill) {
  LayerScene scene;
  scene.least = {-0.03, 0.0};
  scene.most = {-0.015, 0.2};
  scene.step = {0.0, 0.0};
  double share = 0.0;
  const auto note = [&share](int, const DeformableSlam&, const FrameReport& report) {
    share = report.foreground;
  };
  TrackLayer(scene, StillCamera(), 15, note);
  EXPECT_GT(share, 0.02);
  const std::unique_ptr<DeformableSlam> slam = TrackLayer(scene, StillCamera(), 25, note);
  EXPECT_EQ(share, 0.0);
  int on_layer = 0;
  for (int slot = 0; slot < slam->map().num_slots(); ++slot) {
    const double z = slam->map().point(slot).birth_position.z() * slam->unit();
    if (z < 0.5 * (scene.layer + scene.wall)) ++on_layer;
  }
  EXPECT_GT(on_layer, 50);
}

// A hill rises by more than a tool is thick, but the depth does not jump at its foot.
TEST(Foreground, HasNoTissueThatRises) {
  const PinholeCamera camera = SmallCamera();
  const CameraPose pose;
  ObservedSurfaceOptions options;
  const auto render = [&](double height) {
    DepthImage depth(camera.width, camera.height);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const double x = (u - camera.cx) / 25.0;
        const double y = (v - camera.cy) / 25.0;
        depth(u, v) = static_cast<float>(10.0 - height * std::exp(-x * x - y * y));
      }
    }
    return depth;
  };
  ObservedSurface flat(render(0.0), camera, 1.0, options);
  std::vector<VisiblePoint> visible;
  for (int j = 0; j < flat.height(); j += 2) {
    for (int i = 0; i < flat.width(); i += 2) {
      if (!flat.patch(i, j).valid()) continue;
      VisiblePoint point;
      point.in_camera = point.in_map = flat.patch(i, j).point;
      point.pixel = camera.Project(point.in_camera);
      visible.push_back(point);
    }
  }
  Foreground foreground(camera);
  EXPECT_EQ(foreground.Remove(visible, pose, &flat), 0.0);
  ObservedSurface hill(render(2.0), camera, 1.0, options);
  EXPECT_EQ(foreground.Remove(visible, pose, &hill), 0.0);
}

}  // namespace
}  // namespace ceres_ed
