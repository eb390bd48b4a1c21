#include "ceres_ed/preflight/repair.h"

#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/preflight/faulty_faces.h>
#include <ceres_ed/preflight/near_duplicates.h>

#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

void RemoveFaces(const std::vector<int>& faces, PointCloud* cloud) {
  std::vector<char> is_removed(cloud->triangles.size(), 0);
  for (const int face : faces) is_removed[face] = 1;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < is_removed.size(); ++t) {
    if (is_removed[t] == 0) cloud->triangles[kept++] = cloud->triangles[t];
  }
  cloud->triangles.resize(kept);
}

}  // namespace

std::vector<std::string> RepairCloud(const std::string& name, PointCloud* cloud) {
  std::vector<std::string> done;
  if (!cloud->HasTriangles()) return done;
  const auto say = [&](std::size_t count, const char* what) {
    if (count > 0) done.push_back(name + ": " + std::to_string(count) + what);
  };
  SurfaceTopology topology = BuildTopology(*cloud);
  const auto near = NearDuplicates(*cloud, topology);
  // All points at the position of the first one move to that of the second one.
  std::vector<int> goal(cloud->size());
  for (std::size_t p = 0; p < cloud->size(); ++p) goal[p] = topology.representative[p];
  for (const auto& [from, to] : near) goal[from] = to;
  const std::vector<Eigen::Vector3d> before = cloud->points;
  for (std::size_t p = 0; p < cloud->size(); ++p) {
    cloud->points[p] = before[goal[topology.representative[p]]];
  }
  say(near.size(), " vertices moved to the place of the vertex with which they nearly coincide");
  if (!near.empty()) topology = BuildTopology(*cloud);
  const std::vector<int> duplicates = DuplicateFaces(*cloud, topology);
  RemoveFaces(duplicates, cloud);
  say(duplicates.size(), " triangles that are there twice left out");
  const std::vector<int> degenerate = DegenerateFaces(*cloud);
  // A cloud whose triangles all are without area would become bare points.
  if (degenerate.size() < cloud->triangles.size()) {
    RemoveFaces(degenerate, cloud);
    say(degenerate.size(), " triangles without area left out");
  }
  return done;
}

}  // namespace ceres_ed
