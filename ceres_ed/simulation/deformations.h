// Smooth closed-form deformations of the synthetic shapes. They are the ground truth of a pair or a
// sequence and do not depend on any deformation graph.
#ifndef CERES_ED_SIMULATION_DEFORMATIONS_H_
#define CERES_ED_SIMULATION_DEFORMATIONS_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/simulation/shapes.h>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the position to which `point` moves (both in metres, in the frame of
// MakeSyntheticShape(shape, ..., size)).
//
// `phase` lies in [0, 1]: 0 is the identity, 1 is the full deformation, and the path between them
// is smooth, so that a sequence can move along it in both directions. None of these deformations is
// an embedded-deformation warp:
//   plane    a sum of Gaussian bumps on the sheet, with heights up to 0.06 of the size;
//   dolphin  tail and head are bent down and sideways; the trunk between them does not move at all;
//   heart    contraction around the long axis, shortening, and a twist that grows toward the apex;
//   kidney   a dent in the front (as by an instrument), a slight bend, and a breathing shift;
//   stomach  a bulge of the body, and a bend of the antrum.
// On and inside the body the map is one-to-one, with a positive Jacobian determinant.
Eigen::Vector3d DeformSyntheticPoint(SyntheticShape shape,
                                     double size,
                                     double phase,
                                     const Eigen::Vector3d& point);

// Returns `cloud` with each point moved by DeformSyntheticPoint(), with the same triangles and
// without normals.
PointCloud DeformSyntheticShape(SyntheticShape shape,
                                double size,
                                double phase,
                                const PointCloud& cloud);

}  // namespace ceres_ed

#endif  // CERES_ED_SIMULATION_DEFORMATIONS_H_
