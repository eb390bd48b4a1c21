// Keeps a node near where it is thought to be.
#ifndef CERES_ED_COST_FUNCTIONS_NODE_PRIOR_COST_H_
#define CERES_ED_COST_FUNCTIONS_NODE_PRIOR_COST_H_

#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// Three residuals, in map units:
//   t_j - t_prior
// Parameter blocks: node j (12). Nothing is said of A_j, which follows by E_rot and E_reg.
class NodePriorCost {
 public:
  static constexpr int kNumResiduals = 3;

  explicit NodePriorCost(const Eigen::Vector3d& translation) : translation_(translation) {}

  template <typename T>
  bool operator()(const T* node, T* residuals) const {
    const auto t_j = NodeTranslation(node);
    for (int i = 0; i < 3; ++i) residuals[i] = t_j[i] - T(translation_[i]);
    return true;
  }

  static ceres::CostFunction* Create(const Eigen::Vector3d& translation) {
    return new ceres::AutoDiffCostFunction<NodePriorCost, kNumResiduals, kNodeSize>(
        new NodePriorCost(translation));
  }

 private:
  Eigen::Vector3d translation_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_NODE_PRIOR_COST_H_
