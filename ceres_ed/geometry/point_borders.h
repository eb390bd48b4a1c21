// The border of a surface that is given by bare points.
#ifndef CERES_ED_GEOMETRY_POINT_BORDERS_H_
#define CERES_ED_GEOMETRY_POINT_BORDERS_H_

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns 1 for each point at which the surface ends, otherwise 0: where the directions to its
// nearest points, seen along its normal, leave a gap of more than 120 degrees. Signs of normals do
// not matter. A point without a normal, or with fewer than three neighbours, is none.
std::vector<char> FindBorderPoints(const std::vector<Eigen::Vector3d>& points,
                                   const std::vector<Eigen::Vector3d>& normals,
                                   int num_threads = 1);

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_POINT_BORDERS_H_
