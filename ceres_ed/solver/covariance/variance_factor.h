// The variance of the residuals of a fit, from what is left of them.
#ifndef CERES_ED_SOLVER_COVARIANCE_VARIANCE_FACTOR_H_
#define CERES_ED_SOLVER_COVARIANCE_VARIANCE_FACTOR_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/problem/problem_config.h>
#include <ceres_ed/solver/covariance/state_covariance.h>
#include <ceres_ed/util/status.h>

#include <vector>

namespace ceres_ed {

// The variance of unit weight of least squares: with r_i the residuals of some terms, w_i their
// weights and rho' what their losses leave of these,
//   s0^2 = sum_i w_i rho'_i |r_i|^2 / (sum_i rho'_i rows_i - sum_i tr(J_i Z J_i^T))
// the denominator being the number of rows, each counted as far as its loss does, less the
// parameters that they determine.
struct VarianceFactor {
  // NaN where `redundancy` isn't positive.
  double value = 0.0;
  // sum_i w_i rho'_i |r_i|^2.
  double squared_residuals = 0.0;
  // sum_i rho'_i rows_i.
  double rows = 0.0;
  // sum_i tr(J_i Z J_i^T).
  double parameters = 0.0;

  double redundancy() const { return rows - parameters; }
};

// Of the residuals of `terms` in the problem of `config`, which `covariance` is of. Terms left out
// count as known to be right. The result doesn't depend on the number of threads. Error: a residual
// that can't be evaluated.
StatusOr<VarianceFactor> EstimateVarianceFactor(const ProblemBuilder& builder,
                                                const ProblemConfig& config,
                                                const DeformationState& state,
                                                const StateCovariance& covariance,
                                                const std::vector<int>& terms,
                                                int num_threads);

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_COVARIANCE_VARIANCE_FACTOR_H_
