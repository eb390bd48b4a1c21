#include "ceres_ed/preflight/near_duplicates.h"

#include <ceres_ed/geometry/kd_tree.h>

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

constexpr double kShareOfEdge = 1e-3;

}  // namespace

std::vector<std::pair<int, int>> NearDuplicates(const PointCloud& cloud,
                                                const SurfaceTopology& topology) {
  std::vector<int> border;
  std::vector<Eigen::Vector3d> points;
  for (const int point : topology.walk_order) {
    if (topology.is_border[point] == 0) continue;
    border.push_back(point);
    points.push_back(cloud.points[point]);
  }
  std::vector<std::pair<int, int>> pairs;
  const double reach = kShareOfEdge * MeanEdgeLength(topology);
  if (points.empty() || !(reach > 0.0)) return pairs;
  const KdTree tree(points);
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < border.size(); ++i) {
    tree.RadiusSearch(points[i], reach, &near);
    int lowest = border[i];
    for (const Neighbor& neighbor : near) lowest = std::min(lowest, border[neighbor.index]);
    if (lowest != border[i]) pairs.emplace_back(border[i], lowest);
  }
  return pairs;
}

}  // namespace ceres_ed
