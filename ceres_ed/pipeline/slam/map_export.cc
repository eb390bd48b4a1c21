#include "ceres_ed/pipeline/slam/map_export.h"

#include <ceres_ed/slam/map/deformable_map.h>

#include <cstddef>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {
namespace {

// Calls visit(slot, point, binding, place) for each point of the map. `place` is its current
// position in map units and in the map frame.
template <typename Visit>
void ForEachPoint(const DeformableMap& map, const Visit& visit) {
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    if (!map.alive(slot)) continue;
    const MapPoint point = map.point(slot);
    const PointBinding binding = map.binding(slot);
    visit(slot, point, binding, WarpPoint(map.graph(), map.state(), binding, point.position));
  }
}

}  // namespace

MapSnapshot ExportMap(const DeformableSlam& slam, MapFrame frame) {
  const DeformableMap& map = slam.map();
  const CameraPose& camera_from_map = slam.camera_from_map();
  const bool in_camera = frame == MapFrame::kCamera;
  MapSnapshot snapshot;
  ForEachPoint(
      map,
      [&](int, const MapPoint& point, const PointBinding& binding, const Eigen::Vector3d& place) {
        const Eigen::Vector3d normal = WarpNormal(map.state(), binding, point.normal);
        snapshot.points.push_back(slam.unit() * (in_camera ? camera_from_map * place : place));
        snapshot.normals.push_back(in_camera ? camera_from_map.rotation * normal : normal);
        snapshot.colors.push_back(point.color);
        snapshot.ids.push_back(point.id);
        snapshot.birth_frames.push_back(point.birth_frame);
        snapshot.weights.push_back(point.weight);
        snapshot.stabilities.push_back(point.Stability());
        snapshot.last_seen.push_back(point.last_seen);
      });
  return snapshot;
}

MapCovariances ExportMapCovariances(const DeformableSlam& slam) {
  const double unit = slam.unit();
  MapCovariances map;
  ForEachPoint(
      slam.map(),
      [&](int slot, const MapPoint& point, const PointBinding&, const Eigen::Vector3d& place) {
        map.ids.push_back(point.id);
        map.points.push_back(unit * place);
        map.covariances.push_back(unit * unit * slam.PointCovariance(slot));
      });
  return map;
}

std::vector<LivePoint> ExportLivePoints(const DeformableSlam& slam) {
  const DeformableMap& map = slam.map();
  std::vector<LivePoint> points;
  points.reserve(static_cast<std::size_t>(map.num_points()));
  ForEachPoint(map,
               [&](int, const MapPoint& point, const PointBinding&, const Eigen::Vector3d& place) {
                 LivePoint live;
                 const Eigen::Vector3d in_camera = slam.camera_from_map() * place;
                 live.position = (slam.unit() * in_camera).cast<float>();
                 live.id = point.id;
                 live.birth_frame = point.birth_frame;
                 live.birth_position = (slam.unit() * point.birth_position).cast<float>();
                 live.stability = static_cast<float>(point.Stability());
                 live.last_seen = point.last_seen;
                 points.push_back(live);
               });
  return points;
}

Warp ExportWarp(const DeformableSlam& slam) {
  const DeformableMap& map = slam.map();
  Warp warp;
  warp.binding.neighbors = map.neighbors();
  warp.binding.distance = DistanceRule::kEuclidean;
  for (const Eigen::Vector3d& position : map.graph().positions()) {
    warp.graph.AddNode(slam.unit() * position);
  }
  for (const GraphEdge& edge : map.graph().edges()) warp.graph.AddEdge(edge);
  warp.state = map.state();
  warp.state.camera_from_map = {};
  for (int j = 0; j < warp.state.num_nodes(); ++j) {
    MutableNodeTranslation(warp.state.node(j)) *= slam.unit();
  }
  return warp;
}

CameraPose ExportCameraPose(const DeformableSlam& slam) {
  const CameraPose& camera_from_map = slam.camera_from_map();
  CameraPose map_from_camera;
  map_from_camera.rotation = camera_from_map.rotation.conjugate();
  map_from_camera.translation =
      map_from_camera.rotation * (-slam.unit() * camera_from_map.translation);
  return map_from_camera;
}

}  // namespace ceres_ed
