#include "ceres_ed/report/view/scene.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace ceres_ed {
namespace {

// Keeps the 96 % of the points that are nearest to their median.
void LeaveOutFarPoints(std::vector<Eigen::Vector3d>* points) {
  constexpr double kShare = 0.96;
  if (points->empty()) return;
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& point : *points) values.push_back(point[axis]);
    median[axis] = Median(std::move(values));
  }
  const auto kept = static_cast<std::ptrdiff_t>(kShare * static_cast<double>(points->size()));
  std::nth_element(points->begin(),
                   points->begin() + kept,
                   points->end(),
                   [&median](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
                     return (a - median).squaredNorm() < (b - median).squaredNorm();
                   });
  points->resize(static_cast<std::size_t>(std::max<std::ptrdiff_t>(kept, 1)));
}

}  // namespace

std::vector<Eigen::Vector3d> PointsAt(const ViewSurface& surface, double at) {
  if (surface.moments && !surface.moments->places.empty()) {
    const auto count = static_cast<std::ptrdiff_t>(surface.points.size());
    const auto begin = surface.moments->places.begin() + count * surface.moments->MomentAt(at);
    return {begin, begin + count};
  }
  if (!surface.motion) return surface.points;
  const MotionParts parts = PartsAt(at, PlacementShareOf(surface));
  std::vector<Eigen::Vector3d> moved(surface.points.size());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    moved[i] = surface.motion->Move(surface.points[i], static_cast<int>(i), parts);
  }
  return moved;
}

double PlacementShareOf(const ViewSurface& surface) {
  if (!surface.motion) return 0.0;
  return surface.motion->PlacementShare(surface.points, Diagonal(surface.points));
}

SceneBall BallAround(const Scene& scene) {
  std::vector<std::vector<Eigen::Vector3d>> shown;
  for (const ViewPanel& panel : scene.panels) {
    const ViewSurface& surface = scene.surfaces[panel.surface];
    if (panel.at < 0.0) shown.push_back(PointsAt(surface, 0.0));
    shown.push_back(PointsAt(surface, panel.at < 0.0 ? 1.0 : panel.at));
  }
  if (scene.timeline) {
    std::vector<Eigen::Vector3d> path;
    for (const TimelineFrame& frame : scene.timeline->frames) {
      if (frame.map_from_camera) path.push_back(frame.map_from_camera->translation);
    }
    shown.push_back(std::move(path));
  }
  // A few points of a map that float far away must not make all others small.
  if (scene.timeline) {
    for (std::size_t i = 0; i + 1 < shown.size(); ++i) LeaveOutFarPoints(&shown[i]);
  }
  SceneBall ball;
  Eigen::AlignedBox3d box;
  for (const std::vector<Eigen::Vector3d>& points : shown) box.extend(BoundingBox(points));
  if (box.isEmpty()) return ball;
  ball.center = box.center();
  double farthest = 0.0;
  for (const std::vector<Eigen::Vector3d>& points : shown) {
    for (const Eigen::Vector3d& point : points) {
      farthest = std::max(farthest, (point - ball.center).norm());
    }
  }
  if (farthest > 0.0) ball.radius = farthest;
  return ball;
}

void SetRanges(Scene* scene) {
  std::map<std::string, std::vector<const ScalarField*>> by_key;
  for (const ViewSurface& surface : scene->surfaces) {
    for (const ScalarField& field : surface.fields) by_key[field.key].push_back(&field);
  }
  std::map<std::string, FieldRange> ranges;
  for (const auto& [key, fields] : by_key) ranges[key] = RangeOfFields(fields);
  for (ViewSurface& surface : scene->surfaces) {
    for (ScalarField& field : surface.fields) field.range = ranges[field.key];
  }
}

}  // namespace ceres_ed
