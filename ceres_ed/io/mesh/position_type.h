// The type in which positions are written.
#ifndef CERES_ED_IO_MESH_POSITION_TYPE_H_
#define CERES_ED_IO_MESH_POSITION_TYPE_H_

#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/io/mesh/ply_document.h>

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns whether floats cannot hold `points`: whether rounding them would move a point by more
// than 1e-5 of the diagonal of their bounding box. This happens far from the origin, for example in
// UTM coordinates. It is false for points that all coincide.
inline bool NeedsDoubles(const std::vector<Eigen::Vector3d>& points) {
  constexpr double kMaxShare = 1e-5;
  const double half_ulp = 0.5 * static_cast<double>(std::numeric_limits<float>::epsilon());
  double largest = 0.0;
  for (const Eigen::Vector3d& point : points) {
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  }
  const double diagonal = Diagonal(points);
  return diagonal > 0.0 && half_ulp * largest > kMaxShare * diagonal;
}

// Returns double for points that floats cannot hold, otherwise float.
inline PlyType PositionType(const std::vector<Eigen::Vector3d>& points) {
  return NeedsDoubles(points) ? PlyType::kFloat64 : PlyType::kFloat32;
}

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_POSITION_TYPE_H_
