#include "ceres_ed/slam/frame/corner_weights.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

// A corner is compared with so many neighbours, up to this distance (map units); the weight where
// there are fewer than the fewest; and the difference of the motions at which the weight is zero:
// in map units, and relative to the motion.
constexpr std::size_t kWeighingNeighbors = 8;
constexpr double kWeighingDistance = 4.0;
constexpr std::size_t kFewestNeighbors = 3;
constexpr double kLonelyWeight = 0.3;
constexpr double kCoherentWidth = 0.25;
constexpr double kCoherentShare = 0.25;

}  // namespace

std::vector<double> WeighCorners(const std::vector<PointMatch>& matches,
                                 const CameraPose& camera_from_map) {
  std::vector<Eigen::Vector3d> motions;
  motions.reserve(matches.size());
  for (const PointMatch& m : matches) motions.push_back(m.in_camera - camera_from_map * m.in_map);
  constexpr double kMostSquared = kWeighingDistance * kWeighingDistance;
  std::vector<std::pair<double, std::size_t>> order;
  order.reserve(matches.size());
  std::array<std::vector<double>, 3> near;
  std::vector<double> weights(matches.size());
  for (std::size_t k = 0; k < matches.size(); ++k) {
    order.clear();
    for (std::size_t n = 0; n < matches.size(); ++n) {
      const double squared = (matches[n].in_map - matches[k].in_map).squaredNorm();
      if (squared <= kMostSquared) order.emplace_back(squared, n);
    }
    // The corner itself is the nearest one.
    const std::size_t count = std::min<std::size_t>(kWeighingNeighbors + 1, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    for (std::vector<double>& values : near) values.clear();
    for (std::size_t n = 1; n < count; ++n) {
      for (int axis = 0; axis < 3; ++axis) near[axis].push_back(motions[order[n].second][axis]);
    }
    weights[k] = kLonelyWeight;
    if (near[0].size() < kFewestNeighbors) continue;
    Eigen::Vector3d median;
    for (int axis = 0; axis < 3; ++axis) median[axis] = Median(near[axis]);
    const double width = kCoherentWidth + kCoherentShare * median.norm();
    const double x = (motions[k] - median).norm() / width;
    weights[k] = x < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0;
  }
  return weights;
}

}  // namespace ceres_ed
