// E_reg: neighbouring nodes agree on where each of them goes.
#ifndef CERES_ED_COST_FUNCTIONS_REGULARIZATION_COST_H_
#define CERES_ED_COST_FUNCTIONS_REGULARIZATION_COST_H_

#include <cmath>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <cost_functions/node_parameters.h>
#include <cost_functions/warp.h>
#include <cost_functions/warped_point_cost.h>

namespace ceres_ed {

// Three residuals of the directed edge (j, k) (Eq. 6), in map units:
//   sqrt(alpha_jk) [ A_j (g_k - g_j) + g_j + t_j - (g_k + t_k) ]
// Parameter blocks: node j (12), node k (12). A_k does not enter. Zero at rest, and for every
// motion x -> B x + b that all nodes share; its norm is invariant to a rigid motion of the result.
class RegularizationCost {
 public:
  static constexpr int kNumResiduals = 3;

  // g_j, g_k in map units; alpha_jk >= 0.
  RegularizationCost(const Eigen::Vector3d& g_j, const Eigen::Vector3d& g_k, double alpha_jk)
      : sqrt_alpha_jk_(std::sqrt(alpha_jk)), edge_(g_k - g_j) {}

  template <typename T>
  bool operator()(const T* node_j, const T* node_k, T* residuals) const {
    Eigen::Map<Eigen::Matrix<T, 3, 1>> r(residuals);
    // g_j - g_k = -edge: kept apart from A_j * edge, it cancels exactly at rest.
    r = T(sqrt_alpha_jk_) * (NodeAffine(node_j) * edge_.cast<T>() - edge_.cast<T>() +
                             NodeTranslation(node_j) - NodeTranslation(node_k));
    return true;
  }

  // It is a point functor on an affine combination of the two nodes, of which the second has no
  // offset: its Jacobian costs next to nothing, and solvers know that A_k does not enter.
  static ceres::CostFunction* Create(const Eigen::Vector3d& g_j,
                                     const Eigen::Vector3d& g_k,
                                     double alpha_jk) {
    const RegularizationCost cost(g_j, g_k, alpha_jk);
    const double weights[] = {1.0, -1.0};
    const Eigen::Vector3d offsets[] = {cost.edge_, Eigen::Vector3d::Zero()};
    return new WarpedPointCost<Scaled>(
        Scaled{cost.sqrt_alpha_jk_}, BoundPoint(2, weights, offsets, -cost.edge_), false);
  }

 private:
  struct Scaled {
    static constexpr int kNumResiduals = 3;

    template <typename T>
    bool operator()(const T* point, T* residuals) const {
      for (int i = 0; i < 3; ++i) residuals[i] = T(sqrt_alpha_jk) * point[i];
      return true;
    }

    double sqrt_alpha_jk;
  };

  double sqrt_alpha_jk_;
  Eigen::Vector3d edge_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_REGULARIZATION_COST_H_
