// The unit frame, in which a fit is solved, and the ways into it and out of it.
#ifndef CERES_ED_REGISTRATION_UNIT_FRAME_H_
#define CERES_ED_REGISTRATION_UNIT_FRAME_H_

#include <ceres_ed/energy/energy.h>
#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/similarity.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/problem/problem_types.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns `cloud` moved by `pose`; its normals are turned.
PointCloud Transformed(const Similarity& pose, const PointCloud& cloud);

// Returns unit_from_target. In the unit frame the rigidly placed source has the diagonal 1 and its
// centre at the origin. The axes are those of the target.
Similarity UnitFrame(const PointCloud& placed_source);

// Returns landmarks of the target frame as correspondences in the unit frame.
std::vector<Correspondence> InUnitFrame(const std::vector<Landmark>& constraints,
                                        const Similarity& unit_from_target);

// Returns the motion, in the unit frame, from the place of the source to the given pose. The size
// stays as it was placed; the centre of the source, which is the origin, moves as the poses say.
Similarity GivenFromPlaced(const Similarity& placed,
                           const Similarity& given,
                           const Similarity& unit_from_target);

// Converts a graph and a state from the unit frame to the source frame. With M = unit_from_source,
// g = M^-1 g', A = R^T A' R and t = (s R)^-1 t', which does not change E_rot.
Warp WarpInSourceFrame(const BuiltGraph& graph,
                       const DeformationState& state,
                       const std::vector<Eigen::Vector3d>& source_points,
                       const Similarity& unit_from_source,
                       const Similarity& target_from_source);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_UNIT_FRAME_H_
