#include "ceres_ed/solver/covariance/variance_factor.h"

#include <ceres_ed/util/parallel.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>

namespace ceres_ed {
namespace {

// Adds the contribution of one residual. Returns false if the residual cannot be evaluated.
bool AddResidual(const SelectedResidual& residual,
                 const LossSpec& loss,
                 const DeformationGraph& graph,
                 const DeformationState& state,
                 const StateCovariance& covariance,
                 VarianceFactor* sum) {
  const std::shared_ptr<const ceres::CostFunction> cost = residual.CostFunction(graph);
  std::vector<const double*> blocks;
  blocks.reserve(residual.num_blocks);
  for (int i = 0; i < residual.num_blocks; ++i) {
    blocks.push_back(BlockPointer(state, residual.blocks[i]));
  }
  Eigen::VectorXd r(cost->num_residuals());
  Eigen::MatrixXd of_prediction;
  if (!cost->Evaluate(blocks.data(), r.data(), nullptr) ||
      !covariance.Residual(residual, loss, &of_prediction)) {
    return false;
  }
  double rho[3] = {r.squaredNorm(), 1.0, 0.0};
  if (const auto function = MakeLoss(loss); function != nullptr) {
    function->Evaluate(r.squaredNorm(), rho);
  }
  sum->squared_residuals += residual.weight * rho[1] * r.squaredNorm();
  sum->rows += rho[1] * static_cast<double>(r.size());
  sum->parameters += of_prediction.trace();
  return true;
}

}  // namespace

StatusOr<VarianceFactor> EstimateVarianceFactor(const ProblemBuilder& builder,
                                                const ProblemConfig& config,
                                                const DeformationState& state,
                                                const StateCovariance& covariance,
                                                const std::vector<int>& terms,
                                                int num_threads) {
  std::vector<SelectedResidual> residuals;
  for (const SelectedResidual& residual : builder.Select(config)) {
    if (std::find(terms.begin(), terms.end(), residual.term) != terms.end()) {
      residuals.push_back(residual);
    }
  }
  // Each residual has its own part, so that the order of the sum does not depend on the number of
  // threads.
  std::vector<VarianceFactor> parts(residuals.size());
  std::atomic<bool> ok{true};
  ParallelFor(num_threads, static_cast<int>(residuals.size()), [&](int begin, int end) {
    for (int i = begin; i < end && ok; ++i) {
      const LossSpec& loss = builder.loss(residuals[i].term);
      if (!AddResidual(residuals[i], loss, builder.graph(), state, covariance, &parts[i])) {
        ok = false;
      }
    }
  });
  if (!ok) {
    if (Status status = builder.CheckResiduals(state); !status.ok()) return status;
    return Status::Error("a residual can't be evaluated");
  }
  VarianceFactor factor;
  for (const VarianceFactor& part : parts) {
    factor.squared_residuals += part.squared_residuals;
    factor.rows += part.rows;
    factor.parameters += part.parameters;
  }
  factor.value = factor.redundancy() > 0.0 ? factor.squared_residuals / factor.redundancy()
                                           : std::numeric_limits<double>::quiet_NaN();
  return factor;
}

}  // namespace ceres_ed
