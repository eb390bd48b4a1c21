#include "ceres_ed/slam/frame/association.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

// The order of the points is not that of the patches, so that most patches are not in the cache
// when it is their turn. They are fetched so many points earlier.
constexpr std::size_t kAhead = 8;

// Returns the inverse of the variance of a patch, relative to a typical one.
double NoiseWeight(const SurfacePatch& patch) {
  return std::clamp(1.0 / (patch.relative_noise * patch.relative_noise), 0.1, 4.0);
}

}  // namespace

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
  for (std::size_t i = 0; i < points.size(); ++i) {
    const VisiblePoint& point = points[i];
    if (i + kAhead < points.size()) surface.Prefetch(points[i + kAhead].pixel);
    const SurfacePatch* patch = surface.Find(point.pixel);
    if (patch == nullptr) continue;
    ++result.measured;
    Association match;
    match.visible = static_cast<int>(i);
    match.patch = patch;
    match.distance = patch->normal.dot(point.in_camera - patch->point);
    if (std::abs(match.distance) > options.max_distance) {
      if (match.distance > 0.0) result.seen_through.push_back(static_cast<int>(i));
      if (match.distance < -options.occluded_distance) ++result.occluded;
      continue;
    }
    if ((rotation * point.normal_in_map).dot(patch->normal) < min_cosine) continue;
    const double cosine = -patch->normal.dot(patch->point) / patch->point.norm();
    match.weight = std::clamp(cosine, 0.1, 1.0) * NoiseWeight(*patch);
    result.matches.push_back(match);
    distances.push_back(match.ScaledDistance());
  }
  result.deviation = RobustDeviation(std::move(distances));
  return result;
}

}  // namespace ceres_ed
