#include "ceres_ed/slam/frame/visibility.h"

#include <ceres_ed/graph/warp.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ceres_ed {
namespace {

// Where a point with z <= 0 is said to be in the picture: nowhere.
const Eigen::Vector2d kNoPixel = Eigen::Vector2d::Constant(-1e9);

VisiblePoint Look(const DeformableMap& map,
                  const CameraPose& camera_from_map,
                  const PinholeCamera& camera,
                  int slot) {
  VisiblePoint seen;
  seen.slot = slot;
  const PointBinding binding = map.binding(slot);
  const MapPoint point = map.point(slot);
  seen.in_map = WarpPoint(map.graph(), map.state(), binding, point.position);
  seen.normal_in_map = WarpNormal(map.state(), binding, point.normal);
  seen.in_camera = camera_from_map * seen.in_map;
  seen.pixel = seen.in_camera.z() > 0.0 ? camera.Project(seen.in_camera) : kNoPixel;
  return seen;
}

bool InPicture(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < camera.width - 0.5 &&
         pixel.y() < camera.height - 0.5;
}

}  // namespace

std::vector<VisiblePoint> FindVisible(const DeformableMap& map,
                                      const CameraPose& camera_from_map,
                                      const PinholeCamera& camera,
                                      const VisibilityOptions& options) {
  std::vector<VisiblePoint> candidates;
  std::vector<double> depths;
  for (const int node : map.NodesNearView(ViewVolume(camera_from_map, camera))) {
    for (const int slot : map.points_of_node(node)) {
      VisiblePoint point = Look(map, camera_from_map, camera, slot);
      if (!InPicture(camera, point.pixel)) continue;
      depths.push_back(point.in_camera.z());
      candidates.push_back(point);
    }
  }
  if (candidates.empty()) return candidates;
  // One width for all cells, from the middle of the scene.
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  const double f = std::max(camera.fx, camera.fy);
  const int cell = static_cast<int>(std::clamp(options.cell_size * f / *middle, 2.0, 64.0));
  Image<double> nearest(
      camera.width / cell + 1, camera.height / cell + 1, std::numeric_limits<double>::infinity());
  const auto cell_of = [&](const Eigen::Vector2d& pixel) -> double& {
    return nearest(static_cast<int>(pixel.x() + 0.5) / cell,
                   static_cast<int>(pixel.y() + 0.5) / cell);
  };
  for (const VisiblePoint& point : candidates) {
    double& z = cell_of(point.pixel);
    z = std::min(z, point.in_camera.z());
  }
  const double min_cosine = std::cos(options.max_view_angle_deg * M_PI / 180.0);
  const auto hidden = [&](const VisiblePoint& point) {
    const Eigen::Vector3d normal = camera_from_map.rotation * point.normal_in_map;
    const double facing = -normal.dot(point.in_camera);
    if (!(facing >= min_cosine * point.in_camera.norm())) return true;
    // What the point's own tangent plane rises across a cell: a steep surface doesn't hide itself.
    const double z = point.in_camera.z();
    const double rise = cell * z * z / facing *
                        (std::abs(normal.x()) / camera.fx + std::abs(normal.y()) / camera.fy);
    return z > cell_of(point.pixel) + options.depth_tolerance + rise;
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), hidden), candidates.end());
  return candidates;
}

void UpdateVisible(const DeformableMap& map,
                   const CameraPose& camera_from_map,
                   const PinholeCamera& camera,
                   std::vector<VisiblePoint>* points) {
  for (VisiblePoint& point : *points) point = Look(map, camera_from_map, camera, point.slot);
}

}  // namespace ceres_ed
