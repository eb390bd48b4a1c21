// Robust losses that Ceres lacks. Both are bounded: an outlier's pull falls to nothing.
#ifndef CERES_ED_COST_FUNCTIONS_ROBUST_LOSS_H_
#define CERES_ED_COST_FUNCTIONS_ROBUST_LOSS_H_

#include <cmath>

#include <ceres/loss_function.h>

namespace ceres_ed {

// Welsch: rho(s) = a^2 (1 - exp(-s / a^2)) of the squared residual norm s; rho ~ s for s << a^2 and
// saturates at a^2. `width` a is in the unit of the residual and must be positive.
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

// Geman-McClure: rho(s) = a^2 s / (a^2 + s); saturates at a^2, with heavier tails than Welsch.
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
