// Smoothness of node motion: the graph Laplacian of translations.
#ifndef CERES_ED_COST_FUNCTIONS_LAPLACIAN_COST_H_
#define CERES_ED_COST_FUNCTIONS_LAPLACIAN_COST_H_

#include <algorithm>
#include <utility>
#include <vector>

#include <ceres/cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// Three residuals t_j - sum_k b_k t_k in map units: how far a node moves otherwise than the mean of
// its neighbours. Zero where all move by the same translation; a rotation of all bends it by the
// node's distance from the mean of its neighbours, which is nothing inside a regular graph.
// Parameter blocks: node j, then each neighbour (12 each).
class LaplacianCost final : public ceres::CostFunction {
 public:
  static constexpr int kNumResiduals = 3;

  // b_k >= 0, one a neighbour; they sum to 1.
  explicit LaplacianCost(std::vector<double> neighbor_weights)
      : coefficients_(std::move(neighbor_weights)) {
    for (double& coefficient : coefficients_) coefficient = -coefficient;
    coefficients_.insert(coefficients_.begin(), 1.0);
    set_num_residuals(kNumResiduals);
    mutable_parameter_block_sizes()->assign(coefficients_.size(), kNodeSize);
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    std::fill_n(residuals, kNumResiduals, 0.0);
    for (std::size_t b = 0; b < coefficients_.size(); ++b) {
      for (int i = 0; i < kNumResiduals; ++i) {
        residuals[i] += coefficients_[b] * parameters[b][kNodeTranslationOffset + i];
      }
      // Null for every block that is held.
      if (jacobians == nullptr || jacobians[b] == nullptr) continue;
      std::fill_n(jacobians[b], kNumResiduals * kNodeSize, 0.0);
      for (int i = 0; i < kNumResiduals; ++i) {
        jacobians[b][i * kNodeSize + kNodeTranslationOffset + i] = coefficients_[b];
      }
    }
    return true;
  }

 private:
  std::vector<double> coefficients_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_LAPLACIAN_COST_H_
