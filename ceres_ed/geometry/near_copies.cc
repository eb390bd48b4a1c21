#include "ceres_ed/geometry/near_copies.h"

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/geometry/topology.h>

#include <cstddef>

namespace ceres_ed {

bool HasNearCopies(const std::vector<Eigen::Vector3d>& points) {
  // Ten times the distance at which points are welded.
  constexpr double kNear = 1e-11;
  const double cell = kNear * Diagonal(points);
  if (!(cell > 0.0)) return false;
  std::vector<Eigen::Vector3d> rounded;
  rounded.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    rounded.push_back((point / cell).array().round().matrix() * cell);
  }
  const std::vector<int> first = WeldPoints(rounded);
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[static_cast<std::size_t>(first[p])] != points[p]) return true;
  }
  return false;
}

}  // namespace ceres_ed
