// The warp of Eq. 1, for any scalar type.
#ifndef CERES_ED_COST_FUNCTIONS_WARP_H_
#define CERES_ED_COST_FUNCTIONS_WARP_H_

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// An affine combination of nodes, sum_i w_i [A_i o_i + t_i] + anchor: a point v and the nodes that
// carry it, with all that is constant in Eq. 1 worked out, or any other.
class BoundPoint {
 public:
  // `node_positions[i]` is g of the i-th of `num_nodes` nodes (1 to kMaxBoundNodes) and
  // `weights[i]` its w_i(v); the weights sum to 1. Map units.
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

  // Any weights, offsets o_i and anchor; lengths in map units.
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
  // w_i(v), no unit.
  double weight(int i) const { return weights_[i]; }
  // v - g_i, map units.
  const Eigen::Vector3d& offset(int i) const { return offsets_[i]; }
  // sum_i w_i g_i, map units.
  const Eigen::Vector3d& anchor() const { return anchor_; }

 private:
  int num_nodes_;
  std::array<double, kMaxBoundNodes> weights_{};
  std::array<Eigen::Vector3d, kMaxBoundNodes> offsets_;
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();
};

// The warped point in the map: sum_i w_i [A_i (v - g_i) + g_i + t_i] (inner part of Eq. 1).
// `nodes[i]` is the parameter block of the point's i-th node.
template <typename T>
Eigen::Matrix<T, 3, 1> WarpToMap(const BoundPoint& point, T const* const* nodes) {
  Eigen::Matrix<T, 3, 1> warped = point.anchor().cast<T>();
  for (int i = 0; i < point.num_nodes(); ++i) {
    warped += T(point.weight(i)) * (NodeAffine(nodes[i]) * point.offset(i).template cast<T>() +
                                    NodeTranslation(nodes[i]));
  }
  return warped;
}

// R_c p + T_c (outer part of Eq. 1). `rotation` is a unit quaternion (x y z w), `translation` in
// map units.
template <typename T>
Eigen::Matrix<T, 3, 1> MapToCamera(const T* rotation,
                                   const T* translation,
                                   const Eigen::Matrix<T, 3, 1>& point_in_map) {
  const Eigen::Map<const Eigen::Quaternion<T>> R_c(rotation);
  const Eigen::Map<const Eigen::Matrix<T, 3, 1>> T_c(translation);
  return R_c * point_in_map + T_c;
}

// The derivative of R_c p by the entries x y z w of R_c's quaternion, 3 x 4:
// R p = p + 2 w (u x p) + 2 u x (u x p), with q = (u, w).
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
