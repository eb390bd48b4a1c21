// The pinhole camera. Its x axis points to the right, y down, and z into the scene.
#ifndef CERES_ED_GEOMETRY_PINHOLE_CAMERA_H_
#define CERES_ED_GEOMETRY_PINHOLE_CAMERA_H_

#include <string>

#include <Eigen/Core>

namespace ceres_ed {

// The intrinsics of a rectified image, in pixels. Integer coordinates are pixel centres.
struct PinholeCamera {
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  int width = 0;
  int height = 0;

  // Returns true if every number is finite, the focal lengths are positive, and width and height
  // are at least 1. Otherwise returns false and writes to `error` the value and what was expected.
  bool IsValid(std::string* error) const;

  // Returns the pixel coordinates of a point in the camera frame, which must have z > 0.
  Eigen::Vector2d Project(const Eigen::Vector3d& point) const {
    return {fx * point.x() / point.z() + cx, fy * point.y() / point.z() + cy};
  }

  // Returns the point in the camera frame that is behind pixel (u, v) at `depth` along the optical
  // axis, in the unit of `depth`.
  Eigen::Vector3d BackProject(double u, double v, double depth) const {
    return {(u - cx) / fx * depth, (v - cy) / fy * depth, depth};
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_PINHOLE_CAMERA_H_
