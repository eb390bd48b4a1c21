// Points that are at one place up to rounding.
#ifndef CERES_ED_GEOMETRY_NEAR_COPIES_H_
#define CERES_ED_GEOMETRY_NEAR_COPIES_H_

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns whether there are two points that are nearer to each other than about 1e-11 of the
// diagonal, but not at exactly the same position. Whether WeldPoints() takes such points for one
// may depend on the frame in which they are: moving a cloud rounds its points.
bool HasNearCopies(const std::vector<Eigen::Vector3d>& points);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_NEAR_COPIES_H_
