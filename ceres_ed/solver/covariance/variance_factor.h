// Estimates the variance of the residuals of a fit from their values at the minimum.
#ifndef CERES_ED_SOLVER_COVARIANCE_VARIANCE_FACTOR_H_
#define CERES_ED_SOLVER_COVARIANCE_VARIANCE_FACTOR_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/solver/covariance/state_covariance.h>
#include <ceres_ed/util/status.h>

#include <vector>

namespace ceres_ed {

// The variance of unit weight in least squares. With r_i the residuals of some terms, w_i their
// weights and rho'_i the factors by which their losses reduce these weights,
//   s0^2 = sum_i w_i rho'_i |r_i|^2 / (sum_i rho'_i rows_i - sum_i tr(J_i Z J_i^T))
// The denominator is the number of rows, each counted with the factor of its loss, minus the number
// of parameters that they determine.
struct VarianceFactor {
  // s0^2, or NaN if redundancy() is not positive.
  double value = 0.0;
  // sum_i w_i rho'_i |r_i|^2.
  double squared_residuals = 0.0;
  // sum_i rho'_i rows_i.
  double rows = 0.0;
  // sum_i tr(J_i Z J_i^T).
  double parameters = 0.0;

  double redundancy() const { return rows - parameters; }
};

// Returns the variance factor of the residuals of `terms` in the problem of `config`, whose
// covariance is `covariance`. Other terms are assumed to be weighted correctly. The result does not
// depend on the number of threads. It is an error if a residual cannot be evaluated.
StatusOr<VarianceFactor> EstimateVarianceFactor(const ProblemBuilder& builder,
                                                const ProblemConfig& config,
                                                const DeformationState& state,
                                                const StateCovariance& covariance,
                                                const std::vector<int>& terms,
                                                int num_threads);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_COVARIANCE_VARIANCE_FACTOR_H_
