// Smoothness of node motion: the graph Laplacian of translations.
#ifndef CERES_ED_COST_FUNCTIONS_LAPLACIAN_COST_H_
#define CERES_ED_COST_FUNCTIONS_LAPLACIAN_COST_H_

#include <algorithm>
#include <utility>
#include <vector>

#include <ceres/cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The graph Laplacian of the node translations. It has three residuals, in map units:
//   t_j - sum_k b_k t_k
// They are the difference between the translation of node j and the weighted mean of the
// translations of its neighbours k. They are zero when all nodes have the same translation. When
// all nodes rotate together, they grow with the distance of node j from the mean position of its
// neighbours, which is zero inside a regular graph.
// Parameter blocks: node j, then each neighbour (12 each).
class LaplacianCost final : public ceres::CostFunction {
 public:
  static constexpr int kNumResiduals = 3;

  // `neighbor_weights` has one b_k >= 0 for each neighbour. The weights sum to 1.
  explicit LaplacianCost(std::vector<double> neighbor_weights)
      : coefficients_(std::move(neighbor_weights)) {
    for (double& coefficient : coefficients_) coefficient = -coefficient;
    coefficients_.insert(coefficients_.begin(), 1.0);
    set_num_residuals(kNumResiduals);
    mutable_parameter_block_sizes()->assign(coefficients_.size(), kNodeSize);
  }

  // Computes the residuals and, where asked for, the Jacobians. Always returns true.
  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    std::fill_n(residuals, kNumResiduals, 0.0);
    for (std::size_t b = 0; b < coefficients_.size(); ++b) {
      for (int i = 0; i < kNumResiduals; ++i) {
        residuals[i] += coefficients_[b] * parameters[b][kNodeTranslationOffset + i];
      }
      // Ceres passes a null pointer for each block that is held constant.
      if (jacobians == nullptr || jacobians[b] == nullptr) continue;
      std::fill_n(jacobians[b], kNumResiduals * kNodeSize, 0.0);
      for (int i = 0; i < kNumResiduals; ++i) {
        jacobians[b][i * kNodeSize + kNodeTranslationOffset + i] = coefficients_[b];
      }
    }
    return true;
  }

 private:
  // One coefficient for each parameter block: 1 for node j, -b_k for its neighbours.
  std::vector<double> coefficients_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_LAPLACIAN_COST_H_
