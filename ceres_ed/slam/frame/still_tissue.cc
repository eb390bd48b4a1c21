#include "ceres_ed/slam/frame/still_tissue.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

// The number of points from which a node counts.
constexpr std::ptrdiff_t kFewestPoints = 5;

}  // namespace

double SpreadBetweenNodes(std::vector<NodeResidual> residuals,
                          double points_per_window,
                          double least_deviation) {
  // The order of the sums, and so their last digits, follows that of the points.
  const auto by_node = [](const NodeResidual& a, const NodeResidual& b) { return a.node < b.node; };
  std::stable_sort(residuals.begin(), residuals.end(), by_node);
  double between = 0.0, within = 0.0;
  std::ptrdiff_t num_nodes = 0, num_points = 0;
  for (auto first = residuals.begin(); first != residuals.end();) {
    const auto last = std::upper_bound(first, residuals.end(), *first, by_node);
    double sum = 0.0, squares = 0.0;
    for (auto r = first; r != last; ++r) {
      sum += r->distance;
      squares += r->distance * r->distance;
    }
    const auto count = last - first;
    first = last;
    if (count < kFewestPoints) continue;
    const double of_mean = sum * sum / static_cast<double>(count);
    between += of_mean;
    within += squares - of_mean;
    ++num_nodes;
    num_points += count;
  }
  if (num_nodes == 0) return 0.0;
  const double variance = std::max(within / static_cast<double>(num_points - num_nodes),
                                   least_deviation * least_deviation);
  return between / static_cast<double>(num_nodes) / variance / std::max(1.0, points_per_window);
}

Coherence CornerCoherence(const std::vector<PointMatch>& matches,
                          const CameraPose& camera_from_map,
                          double reach) {
  std::vector<Eigen::Vector3d> residuals;
  residuals.reserve(matches.size());
  for (const PointMatch& m : matches) residuals.push_back(m.in_camera - camera_from_map * m.in_map);
  double sum = 0.0, squared = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((matches[i].in_map - matches[j].in_map).squaredNorm() > reach * reach) continue;
      const double weight = matches[i].weight * matches[j].weight;
      const double product = weight * residuals[i].dot(residuals[j]);
      sum += product;
      squared += product * product;
      scale += 0.5 * weight * (residuals[i].squaredNorm() + residuals[j].squaredNorm());
    }
  }
  if (!(scale > 0.0)) return {};
  return {sum / scale, std::sqrt(squared) / scale};
}

}  // namespace ceres_ed
