#include "ceres_ed/registration/uncertainty/way_spread.h"

#include <ceres_ed/graph/warp.h>

namespace ceres_ed {

void WaySpread::Add(const std::vector<Eigen::Vector3d>& points,
                    const BuiltGraph& graph,
                    const DeformationState& state,
                    int num_threads) {
  WarpPoints(graph.graph, state, graph.skinning, points, num_threads, &ends_.emplace_back());
}

Eigen::Matrix3d WaySpread::About(const Eigen::Vector3d& place, std::size_t point) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const std::vector<Eigen::Vector3d>& end : ends_) {
    const Eigen::Vector3d d = end[point] - place;
    sum += d * d.transpose();
  }
  return ends_.empty() ? sum : Eigen::Matrix3d(sum / static_cast<double>(ends_.size()));
}

}  // namespace ceres_ed
