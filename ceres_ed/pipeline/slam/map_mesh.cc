#include "ceres_ed/pipeline/slam/map_mesh.h"

#include <ceres_ed/io/mesh/surface_module.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/pipeline/slam/map_export.h>

#include <utility>

namespace ceres_ed {

Status PrepareMapMesh(const std::string& path) {
  Status status = PrepareOutput(path);
  // A run of hours must not end with the news that a library is missing.
  if (status.ok()) status = ConnectPoints(path, {}, {}, 1.0).status();
  return status;
}

Status WriteMapMesh(const std::string& path, const DeformableSlam& slam, double point_spacing) {
  constexpr double kLongestEdge = 4.0;
  const MapSnapshot map = ExportMap(slam);
  const double longest = kLongestEdge * point_spacing * slam.unit();
  StatusOr<SurfaceTriangles> triangles = ConnectPoints(path, map.points, map.normals, longest);
  if (!triangles.ok()) return triangles.status();
  return WriteMapCloud(path, map, *triangles);
}

}  // namespace ceres_ed
