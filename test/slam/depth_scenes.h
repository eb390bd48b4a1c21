// Depth images of surfaces that are given by a formula, with the expected results.
#ifndef CERES_ED_TEST_SLAM_DEPTH_SCENES_H_
#define CERES_ED_TEST_SLAM_DEPTH_SCENES_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/visibility.h>

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// The relative error of a pixel, because depth images store floats.
constexpr double kFloatRounding = 6e-8;

// A camera with a field of view of 67 by 53 degrees.
inline PinholeCamera SmallCamera() { return {120.0, 120.0, 79.5, 59.5, 160, 120}; }

// Returns a rotation by `angle` radians about `axis`, followed by a shift.
inline CameraPose Motion(double angle,
                         const Eigen::Vector3d& axis,
                         const Eigen::Vector3d& translation) {
  CameraPose motion;
  motion.rotation = Eigen::AngleAxisd(angle, axis.normalized());
  motion.translation = translation;
  return motion;
}

// Returns the depth image of depth_of(ray), which returns the z at which a ray (x, y, 1) of the
// camera frame meets the surface, or 0 if it does not.
template <typename DepthOf>
DepthImage RenderDepth(const PinholeCamera& camera, const DepthOf& depth_of) {
  DepthImage depth(camera.width, camera.height, 0.0F);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      depth(u, v) = static_cast<float>(depth_of(camera.BackProject(u, v, 1.0)));
    }
  }
  return depth;
}

// The plane through `point` with the unit vector `normal`, in the camera frame.
struct PlaneScene {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;

  double operator()(const Eigen::Vector3d& ray) const {
    const double z = normal.dot(point) / normal.dot(ray);
    return std::isfinite(z) && z > 0.0 ? z : 0.0;
  }
  double Distance(const Eigen::Vector3d& x) const { return normal.dot(x - point); }
};

// Returns a plane at `depth` on the optical axis, tilted by `slope_deg` toward `azimuth_deg`. Its
// normal points to the camera.
inline PlaneScene TiltedPlane(double depth, double slope_deg, double azimuth_deg) {
  const double slope = slope_deg * M_PI / 180.0;
  const double azimuth = azimuth_deg * M_PI / 180.0;
  return {
      {0.0, 0.0, depth},
      {std::sin(slope) * std::cos(azimuth), std::sin(slope) * std::sin(azimuth), -std::cos(slope)}};
}

// The surface z = depth + hills in the map frame, under a camera near the origin of the map. The
// slopes are up to 35 degrees in both directions, so that no motion maps the surface onto itself.
struct HillScene {
  double depth = 8.0;
  CameraPose camera_from_map;

  static double Hills(double x, double y) {
    return 0.5 * std::sin(1.1 * x + 0.3) * std::cos(0.9 * y - 0.4) + 0.15 * std::sin(1.7 * y + x);
  }

  double operator()(const Eigen::Vector3d& ray) const {
    const CameraPose map_from_camera = camera_from_map.Inverse();
    const Eigen::Vector3d d = map_from_camera.rotation * ray;
    double z = depth;
    for (int k = 0; k < 60; ++k) {
      const Eigen::Vector3d x = map_from_camera.translation + z * d;
      const double step = (depth + Hills(x.x(), x.y()) - x.z()) / d.z();
      z += 0.7 * step;
    }
    return z;
  }
};

// Returns a visible point of a map for a camera at `camera_from_map`.
inline VisiblePoint MakeVisible(const PinholeCamera& camera,
                                const CameraPose& camera_from_map,
                                const Eigen::Vector3d& in_camera,
                                const Eigen::Vector3d& normal_in_camera) {
  const CameraPose map_from_camera = camera_from_map.Inverse();
  VisiblePoint point;
  point.in_map = map_from_camera * in_camera;
  point.normal_in_map = map_from_camera.rotation * normal_in_camera;
  point.in_camera = in_camera;
  point.pixel = camera.Project(in_camera);
  return point;
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SLAM_DEPTH_SCENES_H_
