// Which points a camera sees.
#ifndef CERES_ED_GEOMETRY_VISIBILITY_BUFFER_H_
#define CERES_ED_GEOMETRY_VISIBILITY_BUFFER_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/z_buffer.h>

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the pixel that a point of the camera frame falls on, or nothing when it is behind the
// camera or outside the picture. Integers are pixel centres: column 0 takes u from -0.5 up to 0.5.
std::optional<std::array<int, 2>> PixelOf(const PinholeCamera& camera,
                                          const Eigen::Vector3d& point);

// What occluders hide, by the nearest depth at each pixel.
class VisibilityBuffer {
 public:
  // Nothing occludes yet.
  explicit VisibilityBuffer(const PinholeCamera& camera);

  // Adds triangles in the camera frame, sampled at the centres of the pixels. What is behind the
  // camera occludes nothing.
  void AddTriangles(const PointCloud& mesh);

  // Adds points in the camera frame as squares parallel to the picture, with a half side of one and
  // a half times the median distance to the nearest other point: without gaps on a surface.
  void AddPoints(const std::vector<Eigen::Vector3d>& points);

  // True for a point in the picture that lies behind no occluder by more than `tolerance` times its
  // own depth.
  bool Sees(const Eigen::Vector3d& point, double tolerance) const;

 private:
  using Triangle = std::array<Eigen::Vector3d, 3>;
  void AddTriangle(const Triangle& corners);

  PinholeCamera camera_;
  ZBuffer<float> nearest_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_VISIBILITY_BUFFER_H_
