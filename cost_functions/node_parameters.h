// The layout of the parameters of a node and of the camera. No other file knows it.
#ifndef CERES_ED_COST_FUNCTIONS_NODE_PARAMETERS_H_
#define CERES_ED_COST_FUNCTIONS_NODE_PARAMETERS_H_

#include <algorithm>

#include <Eigen/Core>

namespace ceres_ed {

// A node is one parameter block of 12 doubles: the affine matrix A_j column by column (c1 c2 c3),
// then the translation t_j. At rest A_j = I and t_j = 0.
inline constexpr int kNodeSize = 12;
// The index of the first entry of t_j in a node block.
inline constexpr int kNodeTranslationOffset = 9;

// The camera has two parameter blocks: the rotation R_c as a unit quaternion in Eigen's order (x y
// z w), which is put on ceres::EigenQuaternionManifold, and the translation T_c in map units.
// Together they take map points into the camera frame.
inline constexpr int kRotationSize = 4;
inline constexpr int kTranslationSize = 3;

// The largest number of nodes to which a point can be bound. It is larger than needed in practice
// and fixes the size of the arrays in the warp.
inline constexpr int kMaxBoundNodes = 8;

// Returns A_j of a node block as a 3 x 3 view (no copy).
template <typename T>
Eigen::Map<const Eigen::Matrix<T, 3, 3>> NodeAffine(const T* node) {
  return Eigen::Map<const Eigen::Matrix<T, 3, 3>>(node);
}
// Returns A_j of a node block as a 3 x 3 view that can be written to.
inline Eigen::Map<Eigen::Matrix3d> MutableNodeAffine(double* node) {
  return Eigen::Map<Eigen::Matrix3d>(node);
}

// Returns t_j of a node block as a view of three values, in map units (no copy).
template <typename T>
Eigen::Map<const Eigen::Matrix<T, 3, 1>> NodeTranslation(const T* node) {
  return Eigen::Map<const Eigen::Matrix<T, 3, 1>>(node + kNodeTranslationOffset);
}
// Returns t_j of a node block as a view that can be written to, in map units.
inline Eigen::Map<Eigen::Vector3d> MutableNodeTranslation(double* node) {
  return Eigen::Map<Eigen::Vector3d>(node + kNodeTranslationOffset);
}

// Writes A = I, t = 0 into a node block.
inline void SetNodeToRest(double* node) {
  std::fill_n(node, kNodeSize, 0.0);
  node[0] = node[4] = node[8] = 1.0;
}

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_NODE_PARAMETERS_H_
