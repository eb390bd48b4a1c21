// Triangles that add nothing to a surface.
#ifndef CERES_ED_PREFLIGHT_FAULTY_FACES_H_
#define CERES_ED_PREFLIGHT_FAULTY_FACES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <vector>

namespace ceres_ed {

// Returns the triangles whose corners are at the same three positions as those of a triangle before
// them, in any order; lowest index first. `topology` must be that of `cloud`.
std::vector<int> DuplicateFaces(const PointCloud& cloud, const SurfaceTopology& topology);

// Returns the triangles whose area is less than 1e-7 of the square of their longest edge; lowest
// index first.
std::vector<int> DegenerateFaces(const PointCloud& cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_FAULTY_FACES_H_
