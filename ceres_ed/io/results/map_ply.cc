#include "ceres_ed/io/results/map_ply.h"

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/io/cloud_io.h>

namespace ceres_ed {
namespace {

template <typename T>
PlyProperty Column(const char* name, PlyType type, const std::vector<T>& values) {
  return MakePlyScalar(name, type, std::vector<double>(values.begin(), values.end()));
}

}  // namespace

Status WriteMapCloud(const std::string& path,
                     const MapSnapshot& map,
                     const std::vector<std::array<int, 3>>& triangles) {
  PointCloud cloud;
  cloud.triangles = triangles;
  cloud.points = map.points;
  cloud.normals = map.normals;
  CloudWriteOptions options;
  options.colors = map.colors;
  options.columns = {Column("id", PlyType::kInt32, map.ids),
                     Column("birth_frame", PlyType::kInt32, map.birth_frames),
                     Column("weight", PlyType::kFloat32, map.weights),
                     Column("stability", PlyType::kFloat32, map.stabilities),
                     Column("last_seen", PlyType::kInt32, map.last_seen)};
  options.comments = {"map frame, metres"};
  return WriteCloud(path, cloud, options);
}

}  // namespace ceres_ed
