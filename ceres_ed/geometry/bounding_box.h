// The extent of a set of points.
#ifndef CERES_ED_GEOMETRY_BOUNDING_BOX_H_
#define CERES_ED_GEOMETRY_BOUNDING_BOX_H_

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// Returns the axis-aligned box around `points`. For no points it is empty (isEmpty()).
inline Eigen::AlignedBox3d BoundingBox(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points) box.extend(point);
  return box;
}

// Returns the length of the diagonal of the bounding box, in the unit of the points; 0 for no
// points.
inline double Diagonal(const std::vector<Eigen::Vector3d>& points) {
  return points.empty() ? 0.0 : BoundingBox(points).diagonal().norm();
}

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_BOUNDING_BOX_H_
