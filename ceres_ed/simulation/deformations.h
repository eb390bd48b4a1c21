// Smooth closed-form deformations of the synthetic shapes: truth that no graph has made.
#ifndef CERES_ED_SIMULATION_DEFORMATIONS_H_
#define CERES_ED_SIMULATION_DEFORMATIONS_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/simulation/shapes.h>

#include <Eigen/Core>

namespace ceres_ed {

// Returns where `point` (metres, in the frame of MakeSyntheticShape(shape, ..., size)) goes.
//
// `phase` in [0, 1]: 0 is the identity, 1 the full deformation, and the path between is smooth, so
// that a sequence can swing along it. None is an embedded-deformation warp:
//   plane    a sum of Gaussian bumps across the sheet, up to 0.06 of the size;
//   dolphin  tail and head bent down and sideways, the trunk between them held exactly;
//   heart    contraction around the long axis, shortening, and a twist that grows to the apex;
//   kidney   an indentation of the front as by an instrument, a slight bend, and a breathing shift;
//   stomach  a bulge of the body, and the antrum bent.
// One-to-one with a positive Jacobian determinant on and inside the body.
Eigen::Vector3d DeformSyntheticPoint(SyntheticShape shape,
                                     double size,
                                     double phase,
                                     const Eigen::Vector3d& point);

// Returns `cloud` with each point moved by DeformSyntheticPoint, the same triangles, no normals.
PointCloud DeformSyntheticShape(SyntheticShape shape,
                                double size,
                                double phase,
                                const PointCloud& cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_DEFORMATIONS_H_
