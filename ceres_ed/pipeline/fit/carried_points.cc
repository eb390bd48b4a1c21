#include "ceres_ed/pipeline/fit/carried_points.h"

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/kd_tree.h>

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

Corners CornersOf(const std::vector<Eigen::Vector3d>& points, const std::array<int, 3>& triangle) {
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = points[static_cast<std::size_t>(triangle[i])];
  return corners;
}

// Twice the area, and axes along the first edge and the normal; the axes are not finite where the
// area is zero.
struct Frame {
  double area = 0.0;
  Eigen::Matrix3d axes;
};

Frame FrameOf(const Corners& corners) {
  Frame frame;
  const Eigen::Vector3d edge = corners[1] - corners[0];
  const Eigen::Vector3d normal = edge.cross(corners[2] - corners[0]);
  frame.area = normal.norm();
  frame.axes.col(0) = edge / edge.norm();
  frame.axes.col(2) = normal / frame.area;
  frame.axes.col(1) = frame.axes.col(2).cross(frame.axes.col(0));
  return frame;
}

Eigen::Vector3d Mean(const Corners& corners, const Eigen::Vector3d& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

}  // namespace

std::vector<Eigen::Vector3d> CarryPoints(const PointCloud& surface,
                                         const std::vector<Eigen::Vector3d>& moved,
                                         const Similarity& overall,
                                         const std::vector<Eigen::Vector3d>& points) {
  CHECK_EQ(moved.size(), surface.size());
  CHECK(!surface.empty());
  const SurfaceIndex index(surface);
  const KdTree tree(surface.points);
  std::vector<Eigen::Vector3d> carried;
  for (const Eigen::Vector3d& point : points) {
    const SurfaceHit hit = index.Closest(point);
    if (hit.triangle >= 0) {
      const auto& triangle = surface.triangles[static_cast<std::size_t>(hit.triangle)];
      const Corners before = CornersOf(surface.points, triangle);
      const Corners after = CornersOf(moved, triangle);
      const Frame from = FrameOf(before);
      const Frame to = FrameOf(after);
      const Eigen::Vector3d offset = point - Mean(before, hit.barycentric);
      const Eigen::Vector3d turned =
          std::sqrt(to.area / from.area) * (to.axes * (from.axes.transpose() * offset));
      if (turned.allFinite()) {
        carried.push_back(Mean(after, hit.barycentric) + turned);
        continue;
      }
    }
    const auto nearest =
        static_cast<std::size_t>(hit.found() ? hit.nearest_vertex : tree.Nearest(point).index);
    const Eigen::Vector3d offset = point - surface.points[nearest];
    carried.push_back(moved[nearest] + overall.scale * (overall.rotation * offset));
  }
  return carried;
}

}  // namespace ceres_ed
