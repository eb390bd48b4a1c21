// A prior that keeps a node near an expected translation.
#ifndef CERES_ED_COST_FUNCTIONS_NODE_PRIOR_COST_H_
#define CERES_ED_COST_FUNCTIONS_NODE_PRIOR_COST_H_

#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The difference between the translation of a node and an expected one. It has three residuals, in
// map units:
//   t_j - t_prior
// Parameter blocks: node j (12). The affine matrix A_j is not part of it; E_rot and E_reg determine
// A_j.
class NodePriorCost {
 public:
  static constexpr int kNumResiduals = 3;

  // `translation` is t_prior, in map units.
  explicit NodePriorCost(const Eigen::Vector3d& translation) : translation_(translation) {}

  // Writes the three residuals for the parameter block `node`. Always returns true.
  template <typename T>
  bool operator()(const T* node, T* residuals) const {
    const auto t_j = NodeTranslation(node);
    for (int i = 0; i < 3; ++i) residuals[i] = t_j[i] - T(translation_[i]);
    return true;
  }

  // Returns a new cost function with automatic derivatives. The caller owns it.
  static ceres::CostFunction* Create(const Eigen::Vector3d& translation) {
    return new ceres::AutoDiffCostFunction<NodePriorCost, kNumResiduals, kNodeSize>(
        new NodePriorCost(translation));
  }

 private:
  Eigen::Vector3d translation_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_NODE_PRIOR_COST_H_
