// A wall with a rectangular layer that moves before it, and its tracking.
#ifndef CERES_ED_TEST_SLAM_LAYER_SCENE_H_
#define CERES_ED_TEST_SLAM_LAYER_SCENE_H_

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/simulation/texture.h>
#include <ceres_ed/slam/slam.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace ceres_ed {

// Lengths are in metres. The camera does not move.
struct LayerScene {
  PinholeCamera camera{240.0, 240.0, 159.5, 119.5, 320, 240};
  // The wall is this far away, and the layer this far.
  double wall = 0.1;
  double layer = 0.08;
  // The layer in the first frame, and its motion in each frame.
  Eigen::Vector2d least = {-0.01, 0.0};
  Eigen::Vector2d most = {0.01, 0.1};
  Eigen::Vector2d step = {0.001, 0.0};
  SyntheticTexture wall_texture{3};
  SyntheticTexture layer_texture{4};

  // Returns whether `place`, on the layer in the first frame, is at least `margin` inside.
  bool IsOnLayer(const Eigen::Vector3d& place, double margin = 0.0) const {
    return ((place.head<2>() - least).array() >= margin).all() &&
           ((most - place.head<2>()).array() >= margin).all();
  }

  // Returns whether pixel (u, v) shows the layer, and writes the place that it shows, in the first
  // frame.
  bool ShowsLayer(int u, int v, int frame, Eigen::Vector3d* place) const {
    *place = camera.BackProject(u, v, layer);
    place->head<2>() -= frame * step;
    if (IsOnLayer(*place)) return true;
    *place = camera.BackProject(u, v, wall);
    return false;
  }

  void Render(int frame, DepthImage* depth, ColorImage* color) const {
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        Eigen::Vector3d place;
        const bool is_layer = ShowsLayer(u, v, frame, &place);
        (*depth)(u, v) = static_cast<float>(place.z());
        const Eigen::Vector3d shade =
            (is_layer ? layer_texture : wall_texture).Color(place, place.z() / camera.fx);
        for (int c = 0; c < 3; ++c) {
          (*color)(u, v)[c] =
              static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(shade[c], 0.0, 1.0)));
        }
      }
    }
  }
};

// Tracks `frames` frames of the scene; `after` is called after each of them.
inline std::unique_ptr<DeformableSlam> TrackLayer(
    const LayerScene& scene,
    const SlamOptions& options,
    int frames,
    const std::function<void(int, const DeformableSlam&, const FrameReport&)>& after = {}) {
  StatusOr<std::unique_ptr<DeformableSlam>> slam =
      DeformableSlam::Create(scene.camera, options, BuiltinEnergies());
  EXPECT_TRUE(slam.ok());
  DepthImage depth(scene.camera.width, scene.camera.height);
  ColorImage color(scene.camera.width, scene.camera.height);
  for (int k = 0; k < frames; ++k) {
    scene.Render(k, &depth, &color);
    SlamFrame frame;
    frame.number = k;
    frame.depth = &depth;
    frame.color = &color;
    const FrameReport report = (*slam)->Process(frame);
    if (after) after(k, **slam, report);
  }
  return *std::move(slam);
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SLAM_LAYER_SCENE_H_
