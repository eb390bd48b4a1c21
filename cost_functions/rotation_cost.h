// E_rot: keeps a node's affine matrix near a rotation.
#ifndef CERES_ED_COST_FUNCTIONS_ROTATION_COST_H_
#define CERES_ED_COST_FUNCTIONS_ROTATION_COST_H_

#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// Six residuals that vanish when A_j = [c1 c2 c3] is orthonormal (Eq. 5):
//   c1.c2, c1.c3, c2.c3, c1.c1 - 1, c2.c2 - 1, c3.c3 - 1   (no unit)
// Parameter blocks: node j (12). Invariant to A -> Q A with Q orthonormal; a reflection costs
// nothing, so a solve has to start with det A > 0 and its end be checked for it.
struct RotationCost {
  static constexpr int kNumResiduals = 6;

  template <typename T>
  bool operator()(const T* node, T* residuals) const {
    const auto A_j = NodeAffine(node);
    residuals[0] = A_j.col(0).dot(A_j.col(1));
    residuals[1] = A_j.col(0).dot(A_j.col(2));
    residuals[2] = A_j.col(1).dot(A_j.col(2));
    for (int c = 0; c < 3; ++c) residuals[3 + c] = A_j.col(c).squaredNorm() - T(1.0);
    return true;
  }

  static ceres::CostFunction* Create() {
    return new ceres::AutoDiffCostFunction<RotationCost, kNumResiduals, kNodeSize>(
        new RotationCost);
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_ROTATION_COST_H_
