// The warp of Eq. 1, for any scalar type.
#ifndef CERES_ED_COST_FUNCTIONS_WARP_H_
#define CERES_ED_COST_FUNCTIONS_WARP_H_

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// An affine combination of nodes, sum_i w_i [A_i o_i + t_i] + anchor. It usually is a point v with
// the nodes to which it is bound; all constants of Eq. 1 are then precomputed.
class BoundPoint {
 public:
  // Binds `point` to `num_nodes` nodes (1 to kMaxBoundNodes). `position_of_node(i)` returns g_i,
  // the position of its i-th node, and `weights[i]` is w_i(v). The weights sum to 1. Lengths are in
  // map units.
  template <typename PositionOfNode>
  BoundPoint(const Eigen::Vector3d& point,
             int num_nodes,
             const double* weights,
             const PositionOfNode& position_of_node)
      : num_nodes_(num_nodes) {
    for (int i = 0; i < num_nodes; ++i) {
      const Eigen::Vector3d& g = position_of_node(i);
      weights_[i] = weights[i];
      offsets_[i] = point - g;
      anchor_ += weights[i] * g;
    }
  }

  // Builds any other combination from weights w_i, offsets o_i and an anchor. Lengths are in map
  // units.
  BoundPoint(int num_nodes,
             const double* weights,
             const Eigen::Vector3d* offsets,
             const Eigen::Vector3d& anchor)
      : num_nodes_(num_nodes), anchor_(anchor) {
    for (int i = 0; i < num_nodes; ++i) {
      weights_[i] = weights[i];
      offsets_[i] = offsets[i];
    }
  }

  int num_nodes() const { return num_nodes_; }
  // The weight w_i(v) of the i-th node, without a unit.
  double weight(int i) const { return weights_[i]; }
  // The offset v - g_i from the i-th node, in map units.
  const Eigen::Vector3d& offset(int i) const { return offsets_[i]; }
  // The anchor sum_i w_i g_i, in map units.
  const Eigen::Vector3d& anchor() const { return anchor_; }

 private:
  int num_nodes_;
  std::array<double, kMaxBoundNodes> weights_{};
  std::array<Eigen::Vector3d, kMaxBoundNodes> offsets_;
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();
};

// Returns the warped point in the map frame: sum_i w_i [A_i (v - g_i) + g_i + t_i] (the inner part
// of Eq. 1), in map units. `nodes[i]` is the parameter block of the point's i-th node.
template <typename T>
Eigen::Matrix<T, 3, 1> WarpToMap(const BoundPoint& point, T const* const* nodes) {
  Eigen::Matrix<T, 3, 1> warped = point.anchor().cast<T>();
  for (int i = 0; i < point.num_nodes(); ++i) {
    warped += T(point.weight(i)) * (NodeAffine(nodes[i]) * point.offset(i).template cast<T>() +
                                    NodeTranslation(nodes[i]));
  }
  return warped;
}

// Returns the point in the camera frame: R_c p + T_c (the outer part of Eq. 1). `rotation` is a
// unit quaternion (x y z w); `translation` is in map units.
template <typename T>
Eigen::Matrix<T, 3, 1> MapToCamera(const T* rotation,
                                   const T* translation,
                                   const Eigen::Matrix<T, 3, 1>& point_in_map) {
  const Eigen::Map<const Eigen::Quaternion<T>> R_c(rotation);
  const Eigen::Map<const Eigen::Matrix<T, 3, 1>> T_c(translation);
  return R_c * point_in_map + T_c;
}

// Returns the derivative of R_c p with respect to the entries x y z w of R_c's quaternion, as a 3 x
// 4 matrix. It follows from R p = p + 2 w (u x p) + 2 u x (u x p), with q = (u, w).
inline Eigen::Matrix<double, 3, kRotationSize> RotatedByQuaternion(const Eigen::Quaterniond& R_c,
                                                                   const Eigen::Vector3d& p) {
  const Eigen::Vector3d u = R_c.vec();
  Eigen::Matrix3d p_cross;
  p_cross << 0.0, -p.z(), p.y(), p.z(), 0.0, -p.x(), -p.y(), p.x(), 0.0;
  Eigen::Matrix<double, 3, kRotationSize> derivative;
  derivative.leftCols<3>() = 2.0 * (u.dot(p) * Eigen::Matrix3d::Identity() + u * p.transpose() -
                                    2.0 * p * u.transpose() - R_c.w() * p_cross);
  derivative.col(3) = 2.0 * u.cross(p);
  return derivative;
}

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_WARP_H_
