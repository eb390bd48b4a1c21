#include "ceres_ed/preflight/faulty_faces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

namespace ceres_ed {

std::vector<int> DuplicateFaces(const PointCloud& cloud, const SurfaceTopology& topology) {
  std::vector<std::pair<std::array<int, 3>, int>> faces;
  faces.reserve(cloud.triangles.size());
  for (std::size_t t = 0; t < cloud.triangles.size(); ++t) {
    std::array<int, 3> corners{};
    for (int i = 0; i < 3; ++i) corners[i] = topology.representative[cloud.triangles[t][i]];
    std::sort(corners.begin(), corners.end());
    faces.emplace_back(corners, static_cast<int>(t));
  }
  std::sort(faces.begin(), faces.end());
  std::vector<int> duplicates;
  for (std::size_t i = 1; i < faces.size(); ++i) {
    if (faces[i].first == faces[i - 1].first) duplicates.push_back(faces[i].second);
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

std::vector<int> DegenerateFaces(const PointCloud& cloud) {
  constexpr double kFlat = 1e-7;
  std::vector<int> degenerate;
  for (std::size_t t = 0; t < cloud.triangles.size(); ++t) {
    const auto& [a, b, c] = cloud.triangles[t];
    const Eigen::Vector3d ab = cloud.points[b] - cloud.points[a];
    const Eigen::Vector3d ac = cloud.points[c] - cloud.points[a];
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
    if (!(0.5 * ab.cross(ac).norm() > kFlat * longest)) degenerate.push_back(static_cast<int>(t));
  }
  return degenerate;
}

}  // namespace ceres_ed
