// Robust losses that Ceres does not have. Both are bounded, so that the influence of an outlier
// goes to zero with its distance.
#ifndef CERES_ED_COST_FUNCTIONS_ROBUST_LOSS_H_
#define CERES_ED_COST_FUNCTIONS_ROBUST_LOSS_H_

#include <cmath>

#include <ceres/loss_function.h>

namespace ceres_ed {

// The Welsch loss of the squared residual norm s:
//   rho(s) = a^2 (1 - exp(-s / a^2))
// It is about s for s << a^2 and approaches a^2 for large s. The width a > 0 has the unit of the
// residual.
class WelschLoss final : public ceres::LossFunction {
 public:
  explicit WelschLoss(double width) : squared_width_(width * width) {}
  void Evaluate(double s, double rho[3]) const override {
    const double e = std::exp(-s / squared_width_);
    rho[0] = squared_width_ * (1.0 - e);
    rho[1] = e;
    rho[2] = -e / squared_width_;
  }

 private:
  double squared_width_;
};

// The Geman-McClure loss of the squared residual norm s:
//   rho(s) = a^2 s / (a^2 + s)
// It approaches a^2 for large s, more slowly than the Welsch loss. The width a > 0 has the unit of
// the residual.
class GemanMcClureLoss final : public ceres::LossFunction {
 public:
  explicit GemanMcClureLoss(double width) : squared_width_(width * width) {}
  void Evaluate(double s, double rho[3]) const override {
    const double ratio = squared_width_ / (squared_width_ + s);
    rho[0] = s * ratio;
    rho[1] = ratio * ratio;
    rho[2] = -2.0 * ratio * ratio / (squared_width_ + s);
  }

 private:
  double squared_width_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_ROBUST_LOSS_H_
