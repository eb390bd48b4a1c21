// E_rot: keeps a node's affine matrix near a rotation.
#ifndef CERES_ED_COST_FUNCTIONS_ROTATION_COST_H_
#define CERES_ED_COST_FUNCTIONS_ROTATION_COST_H_

#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The deviation of A_j = [c1 c2 c3] from an orthonormal matrix (Eq. 5). It has six residuals,
// without a unit:
//   c1.c2, c1.c3, c2.c3, c1.c1 - 1, c2.c2 - 1, c3.c3 - 1
// A multiplication A -> Q A by an orthonormal Q does not change them. A reflection therefore costs
// nothing: a solve must start with det A > 0, and its result must be checked for det A > 0.
// Parameter blocks: node j (12).
struct RotationCost {
  static constexpr int kNumResiduals = 6;

  // Writes the six residuals for the parameter block `node`. Always returns true.
  template <typename T>
  bool operator()(const T* node, T* residuals) const {
    const auto A_j = NodeAffine(node);
    residuals[0] = A_j.col(0).dot(A_j.col(1));
    residuals[1] = A_j.col(0).dot(A_j.col(2));
    residuals[2] = A_j.col(1).dot(A_j.col(2));
    for (int c = 0; c < 3; ++c) residuals[3 + c] = A_j.col(c).squaredNorm() - T(1.0);
    return true;
  }

  // Returns a new cost function with automatic derivatives. The caller owns it.
  static ceres::CostFunction* Create() {
    return new ceres::AutoDiffCostFunction<RotationCost, kNumResiduals, kNodeSize>(
        new RotationCost);
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_ROTATION_COST_H_
