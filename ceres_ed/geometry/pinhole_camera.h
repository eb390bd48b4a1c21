// The pinhole camera: x to the right, y down, z into the scene.
#ifndef CERES_ED_GEOMETRY_PINHOLE_CAMERA_H_
#define CERES_ED_GEOMETRY_PINHOLE_CAMERA_H_

#include <string>

#include <Eigen/Core>

namespace ceres_ed {

// Intrinsics of a rectified picture, in pixels; integers are pixel centres.
struct PinholeCamera {
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  int width = 0;
  int height = 0;

  // False, with the value and what was expected in `error`, unless every number is finite, focal
  // lengths are positive and the picture has pixels.
  bool IsValid(std::string* error) const;

  // The pixel of a point with z > 0, camera frame.
  Eigen::Vector2d Project(const Eigen::Vector3d& point) const {
    return {fx * point.x() / point.z() + cx, fy * point.y() / point.z() + cy};
  }

  // The point `depth` along the optical axis behind pixel (u, v), camera frame, unit of `depth`.
  Eigen::Vector3d BackProject(double u, double v, double depth) const {
    return {(u - cx) / fx * depth, (v - cy) / fy * depth, depth};
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_PINHOLE_CAMERA_H_
