#include "ceres_ed/slam/frame/visibility.h"

#include <ceres_ed/geometry/nearest_pixel.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

// The pixel of a point with z <= 0, which is outside of every picture.
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

// Returns the width of all cells in pixels, which is chosen for the median depth of the scene.
int CellSize(const std::vector<VisiblePoint>& points,
             const PinholeCamera& camera,
             const VisibilityOptions& options) {
  if (points.empty()) return 1;
  std::vector<double> depths;
  depths.reserve(points.size());
  for (const VisiblePoint& point : points) depths.push_back(point.in_camera.z());
  const double f = std::max(camera.fx, camera.fy);
  const double pixels = options.cell_size * f / Median(std::move(depths));
  return static_cast<int>(std::clamp(pixels, 2.0, 64.0));
}

}  // namespace

MapOcclusion::MapOcclusion(const std::vector<VisiblePoint>& in_picture,
                           const PinholeCamera& camera,
                           const VisibilityOptions& options)
    : camera_(camera),
      options_(options),
      min_cosine_(std::cos(options.max_view_angle_deg * M_PI / 180.0)),
      nearest_(camera, CellSize(in_picture, camera, options)) {
  for (const VisiblePoint& point : in_picture) {
    nearest_.Add(NearestPixel(point.pixel.x()), NearestPixel(point.pixel.y()), point.in_camera.z());
  }
}

bool MapOcclusion::Sees(const Eigen::Vector3d& place,
                        const Eigen::Vector3d& normal,
                        const Eigen::Vector2d& pixel) const {
  const double facing = -normal.dot(place);
  if (!(facing >= min_cosine_ * place.norm())) return false;
  // The rise of the place's own tangent plane across a cell is allowed in addition, so that a steep
  // surface does not hide itself.
  const double z = place.z();
  const double rise = nearest_.cell() * z * z / facing *
                      (std::abs(normal.x()) / camera_.fx + std::abs(normal.y()) / camera_.fy);
  const double nearest = nearest_.At(NearestPixel(pixel.x()), NearestPixel(pixel.y()));
  return !(z > nearest + options_.depth_tolerance + rise);
}

bool InPicture(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < camera.width - 0.5 &&
         pixel.y() < camera.height - 0.5;
}

std::vector<VisiblePoint> PointsInPicture(const DeformableMap& map,
                                          const CameraPose& camera_from_map,
                                          const PinholeCamera& camera) {
  const std::vector<int> near = map.NodesNearView(ViewVolume(camera_from_map, camera));
  std::size_t most = 0;
  for (const int node : near) most += map.points_of_node(node).size();
  std::vector<VisiblePoint> points;
  points.reserve(most);
  for (const int node : near) {
    for (const int slot : map.points_of_node(node)) {
      const VisiblePoint point = Look(map, camera_from_map, camera, slot);
      if (InPicture(camera, point.pixel)) points.push_back(point);
    }
  }
  return points;
}

std::vector<VisiblePoint> FindVisible(const DeformableMap& map,
                                      const CameraPose& camera_from_map,
                                      const PinholeCamera& camera,
                                      const VisibilityOptions& options) {
  std::vector<VisiblePoint> points = PointsInPicture(map, camera_from_map, camera);
  const MapOcclusion occlusion(points, camera, options);
  const auto hidden = [&](const VisiblePoint& point) {
    const Eigen::Vector3d normal = camera_from_map.rotation * point.normal_in_map;
    return !occlusion.Sees(point.in_camera, normal, point.pixel);
  };
  points.erase(std::remove_if(points.begin(), points.end(), hidden), points.end());
  return points;
}

void UpdateVisible(const DeformableMap& map,
                   const CameraPose& camera_from_map,
                   const PinholeCamera& camera,
                   std::vector<VisiblePoint>* points) {
  for (VisiblePoint& point : *points) point = Look(map, camera_from_map, camera, point.slot);
}

}  // namespace ceres_ed
