#include "ceres_ed/geometry/stray_points.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {
namespace {

constexpr int kLeastUnmeasured = 2;
constexpr double kLongEdge = 10.0;
constexpr double kNearShare = 0.99;
constexpr double kFarRatio = 10.0;

template <typename T>
void KeepRows(const std::vector<int>& new_index, std::vector<T>* rows) {
  if (rows->size() != new_index.size()) return;
  for (std::size_t p = 0; p < new_index.size(); ++p) {
    if (new_index[p] >= 0) (*rows)[new_index[p]] = (*rows)[p];
  }
}

// Returns whether the edges to points at the origin are as long as those of a surface through it.
bool PassesThroughOrigin(const PointCloud& cloud) {
  std::vector<double> at_origin;
  std::vector<double> others;
  for (const std::array<int, 3>& t : cloud.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = cloud.points[t[i]];
      const Eigen::Vector3d& b = cloud.points[t[(i + 1) % 3]];
      const bool is_at_origin = a.isZero(0.0) != b.isZero(0.0);
      (is_at_origin ? at_origin : others).push_back((a - b).norm());
    }
  }
  return !at_origin.empty() &&
         Median(std::move(at_origin)) <= kLongEdge * Median(std::move(others));
}

}  // namespace

std::vector<int> UnmeasuredPoints(const PointCloud& cloud) {
  std::vector<int> unmeasured;
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    if (cloud.points[p].isZero(0.0)) unmeasured.push_back(static_cast<int>(p));
  }
  if (static_cast<int>(unmeasured.size()) < kLeastUnmeasured || PassesThroughOrigin(cloud)) {
    unmeasured.clear();
  }
  return unmeasured;
}

std::vector<int> FarPoints(const PointCloud& cloud) {
  std::vector<int> far;
  if (cloud.empty()) return far;
  Eigen::Vector3d center;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(cloud.size());
    for (const Eigen::Vector3d& point : cloud.points) values.push_back(point[axis]);
    center[axis] = Median(std::move(values));
  }
  std::vector<double> distances;
  distances.reserve(cloud.size());
  for (const Eigen::Vector3d& point : cloud.points) distances.push_back((point - center).norm());
  std::vector<double> sorted = distances;
  const auto near = sorted.begin() + static_cast<std::ptrdiff_t>(
                                         kNearShare * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), near, sorted.end());
  for (std::size_t p = 0; p < distances.size(); ++p) {
    if (*near > 0.0 && distances[p] > kFarRatio * *near) far.push_back(static_cast<int>(p));
  }
  return far;
}

int RemovePoints(const std::vector<int>& points, PointCloud* cloud) {
  if (points.empty()) return 0;
  std::vector<int> new_index(cloud->size(), 0);
  for (const int point : points) new_index[point] = -1;
  int count = 0;
  for (int& index : new_index) {
    if (index >= 0) index = count++;
  }
  KeepRows(new_index, &cloud->points);
  KeepRows(new_index, &cloud->normals);
  KeepRows(new_index, &cloud->intensities);
  cloud->points.resize(count);
  if (!cloud->normals.empty()) cloud->normals.resize(count);
  if (!cloud->intensities.empty()) cloud->intensities.resize(count);
  const std::size_t before = cloud->triangles.size();
  std::vector<std::array<int, 3>> kept;
  kept.reserve(before);
  for (const std::array<int, 3>& t : cloud->triangles) {
    const std::array<int, 3> renamed = {new_index[t[0]], new_index[t[1]], new_index[t[2]]};
    if (*std::min_element(renamed.begin(), renamed.end()) >= 0) kept.push_back(renamed);
  }
  cloud->triangles = std::move(kept);
  return static_cast<int>(before - cloud->triangles.size());
}

}  // namespace ceres_ed
