#include "ceres_ed/pipeline/apply/warped_points.h"

#include <ceres_ed/pipeline/fit/carried_points.h>
#include <ceres_ed/pipeline/fit/named_landmarks.h>
#include <ceres_ed/pipeline/fit/stray_vertices.h>
#include <ceres_ed/pipeline/intention.h>

#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

Status ApplyTo(const Warp& warp, const std::string& warp_path, PointCloud* cloud) {
  const Status status = ApplyWarp(warp, cloud);
  return status.ok() ? status : Status::Error(warp_path + ": " + status.message());
}

}  // namespace

StatusOr<LoadedCloud> LoadFittedSurface(const std::string& path) {
  StatusOr<LoadedCloud> surface = LoadSurface(path);
  if (surface.ok()) LeaveOutStrayVertices(path, &*surface);
  return surface;
}

StatusOr<std::vector<Eigen::Vector3d>> WarpedPoints(const Warp& warp,
                                                    const std::string& warp_path,
                                                    const LoadedCloud* surface,
                                                    const std::vector<Eigen::Vector3d>& points) {
  PointCloud cloud;
  if (surface == nullptr) {
    cloud.points = points;
    if (Status status = ApplyTo(warp, warp_path, &cloud); !status.ok()) return status;
    return std::move(cloud.points);
  }
  cloud = surface->cloud;
  if (Status status = ApplyTo(warp, warp_path, &cloud); !status.ok()) return status;
  return CarryPoints(surface->cloud, cloud.points, warp.target_from_source, points);
}

StatusOr<std::vector<Eigen::Vector3d>> WarpedLandmarks(const Warp& warp,
                                                       const std::string& warp_path,
                                                       const LoadedCloud* surface,
                                                       MeshSpace mesh_space,
                                                       const LandmarkFile& landmarks) {
  const AnatomicalSpace space =
      SpaceOfMesh(mesh_space, surface == nullptr ? PlyDocument() : surface->document);
  std::vector<Eigen::Vector3d> points;
  for (const NamedLandmark& point : landmarks.points) {
    points.push_back(BetweenSpaces(point.position, landmarks.space, space));
  }
  StatusOr<std::vector<Eigen::Vector3d>> warped = WarpedPoints(warp, warp_path, surface, points);
  if (!warped.ok()) return warped;
  for (Eigen::Vector3d& point : *warped) point = BetweenSpaces(point, space, landmarks.space);
  return warped;
}

}  // namespace ceres_ed
