// Robust losses in the Gauss-Newton method.
#ifndef CERES_ED_SOLVER_NORMAL_EQUATIONS_LOSS_CORRECTION_H_
#define CERES_ED_SOLVER_NORMAL_EQUATIONS_LOSS_CORRECTION_H_

#include <cmath>

#include <Eigen/Core>

namespace ceres_ed {

// Scales residuals and Jacobian so that their plain squares have the gradient and the Gauss-Newton
// matrix of the robust cost (Triggs et al. 2000, as in the corrector of Ceres). For a concave loss
// only the first-order part is used, because the second-order part would make the matrix
// indefinite.
class LossCorrection {
 public:
  // `rho` contains the loss and its first two derivatives at `squared_norm` = |r|^2.
  LossCorrection(double squared_norm, const double rho[3])
      : sqrt_rho1_(std::sqrt(rho[1])), residual_scale_(sqrt_rho1_) {
    if (squared_norm == 0.0 || rho[2] <= 0.0) return;
    const double alpha = 1.0 - std::sqrt(1.0 + 2.0 * squared_norm * rho[2] / rho[1]);
    residual_scale_ = sqrt_rho1_ / (1.0 - alpha);
    alpha_per_squared_norm_ = alpha / squared_norm;
  }

  // Corrects the Jacobian in place. `residuals` are the uncorrected values of the cost function;
  // `jacobian` is row-major, rows x columns.
  void CorrectJacobian(const double* residuals, int rows, int columns, double* jacobian) const {
    if (alpha_per_squared_norm_ != 0.0) {
      const Eigen::Map<const Eigen::VectorXd> r(residuals, rows);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(
          jacobian, rows, columns);
      const Eigen::RowVectorXd r_J = r.transpose() * J;
      J -= alpha_per_squared_norm_ * r * r_J;
    }
    for (int i = 0; i < rows * columns; ++i) jacobian[i] *= sqrt_rho1_;
  }

  // Corrects the residuals in place; call it after CorrectJacobian().
  void CorrectResiduals(int rows, double* residuals) const {
    for (int i = 0; i < rows; ++i) residuals[i] *= residual_scale_;
  }

 private:
  double sqrt_rho1_;
  double residual_scale_;
  double alpha_per_squared_norm_ = 0.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_NORMAL_EQUATIONS_LOSS_CORRECTION_H_
