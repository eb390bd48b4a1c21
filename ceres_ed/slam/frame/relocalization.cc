#include "ceres_ed/slam/frame/relocalization.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/registration/rigid/rigid_registration.h>
#include <ceres_ed/slam/frame/association.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

// The number of points on each side that are used for the alignment.
constexpr int kAlignedPoints = 4000;
// The spread that halves a score, in map units.
constexpr double kHalvingDeviation = 0.1;

PointCloud MapCloud(const DeformableMap& map) {
  PointCloud cloud;
  const int stride = std::max(1, map.num_points() / kAlignedPoints);
  int count = 0;
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot) || count++ % stride != 0) continue;
    const MapPoint point = map.point(slot);
    const PointBinding binding = map.binding(slot);
    cloud.points.push_back(WarpPoint(map.graph(), map.state(), binding, point.position));
    cloud.normals.push_back(WarpNormal(map.state(), binding, point.normal));
  }
  return cloud;
}

PointCloud SurfaceCloud(const ObservedSurface& surface) {
  PointCloud cloud;
  const int stride = std::max(
      1, static_cast<int>(std::sqrt(surface.num_valid() / static_cast<double>(kAlignedPoints))));
  for (int j = 0; j < surface.height(); j += stride) {
    for (int i = 0; i < surface.width(); i += stride) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid()) continue;
      cloud.points.push_back(patch.point);
      cloud.normals.push_back(patch.normal);
    }
  }
  return cloud;
}

// Returns whether a cloud is large enough to be placed: it has points, and these are not all at one
// place.
bool CanBePlaced(const PointCloud& cloud) {
  constexpr std::size_t kFewestPoints = 50;
  if (cloud.size() < kFewestPoints) return false;
  Eigen::Vector3d low = cloud.points[0];
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& point : cloud.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm() > 0.5;
}

}  // namespace

double PoseQuality::Score() const {
  if (!(overlap + coverage > 0.0)) return 0.0;
  const double spread = deviation / kHalvingDeviation;
  return overlap * coverage / (overlap + coverage) / (1.0 + spread * spread);
}

PoseQuality JudgePose(const std::vector<VisiblePoint>& visible,
                      const CameraPose& camera_from_map,
                      const ObservedSurface& surface,
                      const PoseQualityOptions& options) {
  PoseQuality quality;
  if (visible.empty() || surface.num_valid() == 0) return quality;
  AssociationOptions near;
  near.max_distance = options.max_distance;
  const AssociationResult association = Associate(visible, camera_from_map, surface, near);
  quality.support =
      static_cast<double>(association.matches.size()) / static_cast<double>(visible.size());
  quality.overlap = options.trust_gaps ? association.MatchedShare() : quality.support;
  quality.deviation = association.deviation;
  quality.points = static_cast<int>(association.matches.size());
  // Each point covers a square of its spacing; the sum of these areas is compared with that of the
  // patches.
  double covered = 0.0;
  const double focal = surface.camera().fx * surface.camera().fy;
  const auto pixels = [focal](const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    return focal * std::abs(normal.dot(point)) / point.norm() / (point.z() * point.z());
  };
  for (const Association& m : association.matches) {
    covered +=
        options.point_spacing * options.point_spacing * pixels(m.patch->point, m.patch->normal);
  }
  const double observed =
      static_cast<double>(surface.num_valid()) * surface.cell() * surface.cell();
  quality.coverage = std::min(1.0, covered / observed);
  return quality;
}

Relocalization Relocalize(const DeformableMap& map,
                          const ObservedSurface& surface,
                          const CameraPose& last,
                          const VisibilityOptions& visibility,
                          const PoseQualityOptions& options) {
  // The whole map is laid onto the observed surface.
  PointCloud source_cloud = MapCloud(map);
  PointCloud target_cloud = SurfaceCloud(surface);
  if (!CanBePlaced(source_cloud) || !CanBePlaced(target_cloud)) return {};
  const Surface source(std::move(source_cloud));
  const Surface target(std::move(target_cloud));
  Similarity initial;
  initial.rotation = last.rotation;
  initial.translation = last.translation;
  RigidOptions rigid;
  rigid.preference = 1.0;
  const RigidResult aligned = AlignRigid(source, target, initial, rigid);
  CameraPose found;
  found.rotation = aligned.target_from_source.rotation;
  found.translation = aligned.target_from_source.translation;

  // The last pose and the new one are refined as in tracking; the better one is returned.
  Relocalization best;
  for (const CameraPose& start : {last, found}) {
    CameraTrackerOptions tracker;
    tracker.max_iterations = 20;
    tracker.association.max_distance = 2.0;
    const std::vector<VisiblePoint> seen = FindVisible(map, start, surface.camera(), visibility);
    const CameraPose pose = TrackCamera(seen, {}, surface, start, tracker).camera_from_map;
    const std::vector<VisiblePoint> refined = FindVisible(map, pose, surface.camera(), visibility);
    const PoseQuality quality = JudgePose(refined, pose, surface, options);
    if (quality.Score() > best.quality.Score()) best = {pose, quality};
  }
  return best;
}

}  // namespace ceres_ed
