// An order in which points that are close in space are close in memory.
#ifndef CERES_ED_GEOMETRY_SPATIAL_ORDER_H_
#define CERES_ED_GEOMETRY_SPATIAL_ORDER_H_

#include <ceres_ed/geometry/point_cloud.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the indices of `points` along a Z curve (Morton 1966) through their bounding box. The
// sequence of positions does not depend on the order of `points`.
std::vector<int> SpatialOrder(const std::vector<Eigen::Vector3d>& points);

// Returns the cloud whose point i is the point order[i] of `cloud`, with triangles in the order of
// their lowest corners. `order` has each index once.
PointCloud Reordered(const PointCloud& cloud, const std::vector<int>& order);

// Returns the place of each index in `order`.
std::vector<int> InverseOrder(const std::vector<int>& order);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_SPATIAL_ORDER_H_
