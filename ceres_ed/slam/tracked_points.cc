#include "ceres_ed/slam/tracked_points.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/slam/checkpoint.h>
#include <ceres_ed/slam/frame/map_growth.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace ceres_ed {
namespace {

const VisiblePoint* FindNearest(const std::vector<VisiblePoint>& visible,
                                const Eigen::Vector3d& in_camera,
                                double* distance) {
  const VisiblePoint* nearest = nullptr;
  double squared = std::numeric_limits<double>::infinity();
  for (const VisiblePoint& candidate : visible) {
    const double d = (candidate.in_camera - in_camera).squaredNorm();
    if (d < squared) nearest = &candidate;
    squared = std::min(squared, d);
  }
  *distance = std::sqrt(squared);
  return nearest;
}

Status TooFar(const NamedPoint& point, double distance, double limit) {
  char text[256];
  std::snprintf(text,
                sizeof(text),
                "point %d at (%.6g, %.6g, %.6g) m is %.4g m from the nearest point of the map, "
                "expected at most %.4g m (the camera frame of the first frame)",
                point.id,
                point.position.x(),
                point.position.y(),
                point.position.z(),
                distance,
                limit);
  return Status::Error(text);
}

}  // namespace

StatusOr<TrackedPoints> TrackedPoints::Bind(const std::vector<NamedPoint>& points,
                                            const DeformableSlam& slam,
                                            const PinholeCamera& camera,
                                            const TrackedPointsOptions& options) {
  const DeformableMap& map = slam.map();
  const CameraPose& pose = slam.camera_from_map();
  const std::vector<VisiblePoint> visible = FindVisible(map, pose, camera, options.visibility);
  PlaceBinder binder(map, pose, camera);
  TrackedPoints tracked;
  tracked.options_ = options;
  for (const NamedPoint& named : points) {
    const Eigen::Vector3d in_camera = named.position / slam.unit();
    double distance = 0.0;
    const VisiblePoint* nearest = FindNearest(visible, in_camera, &distance);
    if (nearest == nullptr || !(distance <= options.max_distance)) {
      return TooFar(named, distance * slam.unit(), options.max_distance * slam.unit());
    }
    const Eigen::Vector3d place = pose.ApplyInverse(in_camera);
    const Binding binding = binder.Bind(place, map.neighbors());
    const LocalWarp warp = map.WarpOf(binding);
    if (!warp.IsInvertible()) {
      return Status::Error("point " + std::to_string(named.id) +
                           " lies where the map is folded, expected a place that is not");
    }
    Point point;
    point.id = named.id;
    point.at_rest = warp.AtRest(place);
    point.normal_at_rest = map.point(nearest->slot).normal;
    point.num_nodes = binding.size;
    std::copy_n(binding.nodes, binding.size, point.nodes.begin());
    std::copy_n(binding.weights, binding.size, point.weights.begin());
    tracked.points_.push_back(point);
  }
  return tracked;
}

std::vector<TrackedPlace> TrackedPoints::Locate(const DeformableSlam& slam,
                                                const PinholeCamera& camera) const {
  const DeformableMap& map = slam.map();
  const CameraPose& pose = slam.camera_from_map();
  const MapOcclusion occlusion(PointsInPicture(map, pose, camera), camera, options_.visibility);
  std::vector<TrackedPlace> places;
  places.reserve(points_.size());
  for (const Point& point : points_) {
    const Eigen::Vector3d in_camera =
        pose * WarpPoint(map.graph(), map.state(), point.binding(), point.at_rest);
    const Eigen::Vector3d normal =
        pose.rotation * WarpNormal(map.state(), point.binding(), point.normal_at_rest);
    TrackedPlace place;
    place.in_camera = slam.unit() * in_camera;
    if (in_camera.z() > 0.0) {
      const Eigen::Vector2d pixel = camera.Project(in_camera);
      place.visible = InPicture(camera, pixel) && occlusion.Sees(in_camera, normal, pixel);
    }
    places.push_back(place);
  }
  return places;
}

void TrackedPoints::Exchange(CheckpointArchive* archive) {
  archive->Enter("tracked_points");
  int count = size();
  archive->Value("count", &count);
  if (!archive->saving()) points_.assign(static_cast<std::size_t>(std::max(0, count)), Point());
  archive->Column("id", &points_, [](Point& p) -> int& { return p.id; });
  archive->Column(
      "at_rest", &points_, [](Point & p) -> auto& { return p.at_rest; });
  archive->Column(
      "normal_at_rest", &points_, [](Point & p) -> auto& { return p.normal_at_rest; });
  archive->Column(
      "nodes", &points_, [](Point & p) -> auto& { return p.nodes; });
  archive->Column(
      "weights", &points_, [](Point & p) -> auto& { return p.weights; });
  archive->Column("num_nodes", &points_, [](Point& p) -> int& { return p.num_nodes; });
  archive->Leave();
}

}  // namespace ceres_ed
