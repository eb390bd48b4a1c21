// A linearised residual on a warped point.
#ifndef CERES_ED_SOLVER_POINT_LINEARIZATION_H_
#define CERES_ED_SOLVER_POINT_LINEARIZATION_H_

#include <Eigen/Core>

namespace ceres_ed {

// What all blocks of a point's nodes and of the camera have in common: with D = dr/dp corrected for
// the loss, the Jacobian by a node is weight * [offset; 1]^T (x) (D R_c), and that by the camera's
// tangent is D C with C = [-2 [R_c p]_x, I].
struct PointLinearization {
  // R_c^T D^T D R_c and R_c^T D^T r.
  Eigen::Matrix3d M;
  Eigen::Vector3d v;
  // D^T D, D^T r, R_c and R_c p; set where there is a camera.
  Eigen::Matrix3d M_camera;
  Eigen::Vector3d v_camera;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d rotated;

  // It is kept among other doubles.
  static constexpr int kNumDoubles = 3 * 9 + 3 * 3;
};
static_assert(sizeof(PointLinearization) == PointLinearization::kNumDoubles * sizeof(double));

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_POINT_LINEARIZATION_H_
