// E_reg: two neighbouring nodes predict the same position for each of them.
#ifndef CERES_ED_COST_FUNCTIONS_REGULARIZATION_COST_H_
#define CERES_ED_COST_FUNCTIONS_REGULARIZATION_COST_H_

#include <cmath>

#include <Eigen/Core>
#include <ceres/cost_function.h>
#include <cost_functions/node_parameters.h>
#include <cost_functions/warp.h>
#include <cost_functions/warped_point_cost.h>

namespace ceres_ed {

// The regularization of the directed edge (j, k) (Eq. 6). It has three residuals, in map units:
//   sqrt(alpha_jk) [ A_j (g_k - g_j) + g_j + t_j - (g_k + t_k) ]
// They compare where node j moves the position of node k with where node k moves itself. A_k is not
// part of them. They are zero at rest, and for every motion x -> B x + b that all nodes share. A
// rigid motion of the result does not change their norm.
// Parameter blocks: node j (12), node k (12).
class RegularizationCost {
 public:
  static constexpr int kNumResiduals = 3;

  // `g_j` and `g_k` are node positions in map units; `alpha_jk` >= 0 is the weight of the edge.
  RegularizationCost(const Eigen::Vector3d& g_j, const Eigen::Vector3d& g_k, double alpha_jk)
      : sqrt_alpha_jk_(std::sqrt(alpha_jk)), edge_(g_k - g_j) {}

  // Writes the three residuals. Always returns true.
  template <typename T>
  bool operator()(const T* node_j, const T* node_k, T* residuals) const {
    Eigen::Map<Eigen::Matrix<T, 3, 1>> r(residuals);
    // g_j - g_k is -edge. The sum A_j * edge - edge is zero exactly at rest.
    r = T(sqrt_alpha_jk_) * (NodeAffine(node_j) * edge_.cast<T>() - edge_.cast<T>() +
                             NodeTranslation(node_j) - NodeTranslation(node_k));
    return true;
  }

  // Returns a new cost function with analytic derivatives. The caller owns it. The residual is a
  // point functor on an affine combination of the two nodes, in which the second node has a zero
  // offset. Therefore its Jacobian is cheap, and solvers know that it does not depend on A_k.
  ceres::CostFunction* MakeCostFunction() const {
    const double weights[] = {1.0, -1.0};
    const Eigen::Vector3d offsets[] = {edge_, Eigen::Vector3d::Zero()};
    return new WarpedPointCost<Scaled>(
        Scaled{sqrt_alpha_jk_}, BoundPoint(2, weights, offsets, -edge_), false);
  }

  // Returns the same as MakeCostFunction() of RegularizationCost(g_j, g_k, alpha_jk).
  static ceres::CostFunction* Create(const Eigen::Vector3d& g_j,
                                     const Eigen::Vector3d& g_k,
                                     double alpha_jk) {
    return RegularizationCost(g_j, g_k, alpha_jk).MakeCostFunction();
  }

  // The square root of the weight of the edge.
  double sqrt_alpha_jk() const { return sqrt_alpha_jk_; }
  // The vector g_k - g_j of the edge, in map units.
  const Eigen::Vector3d& edge() const { return edge_; }

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
