// A depth buffer that tells which points a camera sees.
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

// Returns the pixel (column, row) onto which a point in the camera frame is projected, or nothing
// if the point is behind the camera or outside the image. Integer coordinates are pixel centres:
// column 0 covers u from -0.5 up to 0.5.
std::optional<std::array<int, 2>> PixelOf(const PinholeCamera& camera,
                                          const Eigen::Vector3d& point);

// The depth of the nearest occluder at each pixel.
class VisibilityBuffer {
 public:
  // Starts without occluders.
  explicit VisibilityBuffer(const PinholeCamera& camera);

  // Adds triangles in the camera frame, sampled at the pixel centres. Parts behind the camera do
  // not occlude anything.
  void AddTriangles(const PointCloud& mesh);

  // Adds points in the camera frame as squares parallel to the image. Half a side is one and a half
  // times the median distance of a point to its nearest neighbour, so that the squares of a surface
  // leave no gaps.
  void AddPoints(const std::vector<Eigen::Vector3d>& points);

  // Returns true if the point lies in the image and is not behind an occluder by more than
  // `tolerance` times its own depth.
  bool Sees(const Eigen::Vector3d& point, double tolerance) const;

 private:
  using Triangle = std::array<Eigen::Vector3d, 3>;
  void AddTriangle(const Triangle& corners);

  PinholeCamera camera_;
  ZBuffer<float> nearest_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_VISIBILITY_BUFFER_H_
