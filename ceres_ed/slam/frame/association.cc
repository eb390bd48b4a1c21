#include "ceres_ed/slam/frame/association.h"

#include <algorithm>
#include <cmath>

namespace ceres_ed {

double MedianDeviation(std::vector<double> values) {
  if (values.empty()) return 0.0;
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return 1.4826 * *middle;
}

AssociationResult Associate(const std::vector<VisiblePoint>& points,
                            const CameraPose& camera_from_map,
                            const ObservedSurface& surface,
                            const AssociationOptions& options) {
  AssociationResult result;
  result.matches.reserve(points.size());
  const double min_cosine = std::cos(options.max_angle_deg * M_PI / 180.0);
  const Eigen::Matrix3d rotation = camera_from_map.rotation.toRotationMatrix();
  std::vector<double> distances;
  distances.reserve(points.size());
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const VisiblePoint& point = points[i];
    const SurfacePatch* patch = surface.Find(point.pixel);
    if (patch == nullptr) continue;
    ++result.measured;
    Association match;
    match.visible = i;
    match.patch = patch;
    match.distance = patch->normal.dot(point.in_camera - patch->point);
    if (std::abs(match.distance) > options.max_distance) {
      if (match.distance > 0.0) result.seen_through.push_back(i);
      continue;
    }
    if ((rotation * point.normal_in_map).dot(patch->normal) < min_cosine) continue;
    const double cosine = -patch->normal.dot(patch->point) / patch->point.norm();
    match.weight = std::clamp(cosine, 0.1, 1.0);
    result.matches.push_back(match);
    distances.push_back(match.distance);
  }
  result.deviation = MedianDeviation(std::move(distances));
  return result;
}

}  // namespace ceres_ed
