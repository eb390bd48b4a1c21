#include "ceres_ed/report/view/seen_points.h"

#include <ceres_ed/geometry/closest_point.h>
#include <ceres_ed/geometry/kd_tree.h>
#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace ceres_ed {
double MedianSpacing(const std::vector<Eigen::Vector3d>& points) {
  // More points would not change a median.
  constexpr std::size_t kMost = 2000;
  const KdTree tree(points);
  const std::size_t step = std::max<std::size_t>(1, points.size() / kMost);
  std::vector<double> spacings;
  std::vector<Neighbor> nearest;
  for (std::size_t i = 0; i < points.size(); i += step) {
    if (tree.KNearest(points[i], 2, &nearest) == 2) {
      spacings.push_back(std::sqrt(nearest[1].squared_distance));
    }
  }
  return spacings.empty() ? 0.0 : Median(std::move(spacings));
}

std::vector<char> PointsNotShown(const PointCloud& result, const PointCloud& target) {
  constexpr double kReach = 2.5;
  const SurfaceIndex surface(result);
  std::vector<Eigen::Vector3d> shown;
  shown.reserve(target.size());
  int hint = -1;
  for (const Eigen::Vector3d& point : target.points) {
    const SurfaceHit hit = surface.Closest(point, std::numeric_limits<double>::infinity(), hint);
    if (!hit.found()) continue;
    shown.push_back(hit.position);
    hint = hit.place();
  }
  std::vector<char> not_shown(result.size(), 0);
  const double reach = kReach * MedianSpacing(target.points);
  if (shown.empty() || !(reach > 0.0)) return not_shown;
  const KdTree tree(shown);
  std::size_t count = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    not_shown[i] = tree.NearestWithin(result.points[i], reach).found() ? 0 : 1;
    count += not_shown[i];
  }
  if (count == result.size()) std::fill(not_shown.begin(), not_shown.end(), 0);
  return not_shown;
}

}  // namespace ceres_ed
