#include "ceres_ed/geometry/point_borders.h"

#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kNeighbors = 18;
constexpr int kLeastNeighbors = 3;
// An irregular surface has gaps of up to about a right angle among so many neighbours; at a
// straight border the gap is half a turn.
constexpr double kBorderGap = 120.0 * M_PI / 180.0;

double LargestGap(const Eigen::Vector3d& point,
                  const Eigen::Vector3d& normal,
                  const std::vector<Eigen::Vector3d>& points,
                  const Neighbor* neighbors,
                  int count) {
  const Eigen::Vector3d across = normal.unitOrthogonal();
  const Eigen::Vector3d along = normal.cross(across);
  std::array<double, kNeighbors> angles;
  int size = 0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d offset = points[neighbors[i].index] - point;
    const double x = offset.dot(across);
    const double y = offset.dot(along);
    if (x != 0.0 || y != 0.0) angles[size++] = std::atan2(y, x);
  }
  if (size < kLeastNeighbors) return 0.0;
  std::sort(angles.begin(), angles.begin() + size);
  double gap = angles[0] + 2.0 * M_PI - angles[size - 1];
  for (int i = 1; i < size; ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  return gap;
}

}  // namespace

std::vector<char> FindBorderPoints(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Eigen::Vector3d>& normals,
                                   int num_threads) {
  CHECK_EQ(points.size(), normals.size());
  const KdTree tree(points);
  std::vector<char> is_border(points.size(), 0);
  ParallelFor(num_threads, static_cast<int>(points.size()), [&](int begin, int end) {
    std::array<Neighbor, kNeighbors> nearest;
    for (int p = begin; p < end; ++p) {
      if (normals[p].isZero(0.0)) continue;
      const int count = tree.KNearest(points[p], kNeighbors, nearest.data());
      const double gap = LargestGap(points[p], normals[p], points, nearest.data(), count);
      is_border[p] = static_cast<char>(gap > kBorderGap);
    }
  });
  return is_border;
}

}  // namespace ceres_ed
