// Vertices that should be one, but are not by a rounding error.
#ifndef CERES_ED_PREFLIGHT_NEAR_DUPLICATES_H_
#define CERES_ED_PREFLIGHT_NEAR_DUPLICATES_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/topology.h>

#include <utility>
#include <vector>

namespace ceres_ed {

// Returns pairs of points on the border of a mesh that are at most a thousandth of the mean edge
// apart and not at the same position: the second one is the point of lower index, to whose position
// the first one can be moved. `topology` must be that of `cloud`.
std::vector<std::pair<int, int>> NearDuplicates(const PointCloud& cloud,
                                                const SurfaceTopology& topology);

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_NEAR_DUPLICATES_H_
