// A small sequence in which every frame is known in closed form.
#ifndef CERES_ED_TEST_SLAM_BUMPY_SEQUENCE_H_
#define CERES_ED_TEST_SLAM_BUMPY_SEQUENCE_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace ceres_ed {

inline PinholeCamera BumpyCamera() { return {90.0, 90.0, 47.5, 35.5, 96, 72}; }

// A sheet with bumps, about 0.1 m in front of a camera that moves along x without rotation.
struct BumpyScene {
  // The motion of the camera in metres per frame.
  double camera_step = 0.0005;
  // The amplitude of the sheet's vertical motion in metres.
  double heave = 0.0;

  Eigen::Vector3d CameraPosition(int frame) const { return {camera_step * frame, 0.0, 0.0}; }

  // Returns the z of the sheet above a place in the world frame, which is the frame of the first
  // camera.
  double Height(double x, double y, int frame) const {
    return 0.1 + 0.006 * std::sin(90.0 * x) * std::cos(70.0 * y) +
           0.004 * std::sin(130.0 * (x + y)) + heave * std::sin(0.4 * frame);
  }

  // Returns the depth along the optical axis for a ray (x / z, y / z), computed by bisection.
  double Depth(double u, double v, int frame) const {
    const PinholeCamera camera = BumpyCamera();
    const Eigen::Vector3d ray = camera.BackProject(u, v, 1.0);
    const Eigen::Vector3d origin = CameraPosition(frame);
    double near = 0.05;
    double far = 0.2;
    for (int i = 0; i < 50; ++i) {
      const double z = 0.5 * (near + far);
      const Eigen::Vector3d point = origin + z * ray;
      (point.z() < Height(point.x(), point.y(), frame) ? near : far) = z;
    }
    return 0.5 * (near + far);
  }

  DepthImage RenderDepth(int frame) const {
    DepthImage depth(BumpyCamera().width, BumpyCamera().height);
    for (int v = 0; v < depth.height(); ++v) {
      for (int u = 0; u < depth.width(); ++u) {
        depth(u, v) = static_cast<float>(Depth(u, v, frame));
      }
    }
    return depth;
  }

  // Returns a picture of the pattern that is painted on the sheet.
  ColorImage RenderColor(int frame) const {
    const PinholeCamera camera = BumpyCamera();
    ColorImage color(camera.width, camera.height);
    for (int v = 0; v < color.height(); ++v) {
      for (int u = 0; u < color.width(); ++u) {
        const Eigen::Vector3d p =
            CameraPosition(frame) + camera.BackProject(u, v, Depth(u, v, frame));
        const double shade = 128.0 + 50.0 * std::sin(700.0 * p.x() + 200.0 * p.y()) +
                             40.0 * std::cos(650.0 * p.y() - 300.0 * p.x());
        const auto value = static_cast<std::uint8_t>(std::lround(shade));
        color(u, v) = {value, value, 60};
      }
    }
    return color;
  }
};

inline std::string FrameName(int frame, const char* extension) {
  char name[32];
  std::snprintf(name, sizeof(name), "%06d.%s", frame, extension);
  return name;
}

// Writes frames 0 ... num_frames - 1 in the native layout, with their true poses.
inline void WriteBumpySequence(const std::string& directory,
                               int num_frames,
                               const BumpyScene& scene = {},
                               bool with_color = true) {
  constexpr double kUnitsPerMetre = 50000.0;
  std::filesystem::create_directories(directory + "/depth");
  if (with_color) std::filesystem::create_directories(directory + "/color");
  ASSERT_TRUE(WriteCameraFile(directory + "/camera.txt", {BumpyCamera(), kUnitsPerMetre}).ok());
  std::vector<FramePose> poses(static_cast<std::size_t>(num_frames));
  for (int frame = 0; frame < num_frames; ++frame) {
    const std::string depth = directory + "/depth/" + FrameName(frame, "png");
    ASSERT_TRUE(WriteDepthImage(depth, scene.RenderDepth(frame), kUnitsPerMetre).ok());
    poses[static_cast<std::size_t>(frame)].frame = frame;
    poses[static_cast<std::size_t>(frame)].world_from_camera.translation =
        scene.CameraPosition(frame);
    if (!with_color) continue;
    const std::string color = directory + "/color/" + FrameName(frame, "png");
    ASSERT_TRUE(WriteColorImage(color, scene.RenderColor(frame)).ok());
  }
  ASSERT_TRUE(WritePosesFile(directory + "/poses.txt", poses).ok());
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SLAM_BUMPY_SEQUENCE_H_
