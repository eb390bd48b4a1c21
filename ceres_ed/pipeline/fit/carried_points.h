// Moves points along with a surface on which they lie.
#ifndef CERES_ED_PIPELINE_FIT_CARRIED_POINTS_H_
#define CERES_ED_PIPELINE_FIT_CARRIED_POINTS_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns where `points` are when the points of `surface` have moved to `moved`. Each is attached
// to the nearest triangle at its barycentric coordinates; its offset from the triangle turns and
// scales with it. On points without triangles, and at a triangle without area, it is attached to
// the nearest point, and its offset turns and scales as `overall` does. `moved` has as many points
// as `surface`, which must not be empty.
std::vector<Eigen::Vector3d> CarryPoints(const PointCloud& surface,
                                         const std::vector<Eigen::Vector3d>& moved,
                                         const Similarity& overall,
                                         const std::vector<Eigen::Vector3d>& points);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_CARRIED_POINTS_H_
