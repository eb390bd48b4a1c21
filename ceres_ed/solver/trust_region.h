// The trust region of the Levenberg-Marquardt method.
#ifndef CERES_ED_SOLVER_TRUST_REGION_H_
#define CERES_ED_SOLVER_TRUST_REGION_H_

#include <algorithm>
#include <cmath>

namespace ceres_ed {

// The size of the trust region. A step is damped by the diagonal of the normal equations divided by
// the radius. The rules are those of Nielsen, "Damping parameter in Marquardt's method" (1999),
// with the defaults of Ceres for settings that SolverOptions does not contain.
class TrustRegion {
 public:
  // A solve fails after this many consecutive steps at which a residual cannot be evaluated.
  static constexpr int kMaxConsecutiveInvalidSteps = 5;

  // `radius` > 0 is the initial radius.
  explicit TrustRegion(double radius) : radius_(radius) {}

  double radius() const { return radius_; }
  // Returns whether the radius is so small that the solve has converged.
  bool IsTooSmall() const { return radius_ < 1e-32; }

  // Returns whether a step is accepted. `quality` is the decrease of the cost divided by the
  // decrease that the linearised problem predicts.
  static bool Accepts(double quality) { return quality > 1e-3; }

  // Adapts the radius after an accepted step.
  void Grow(double quality) {
    constexpr double kMaxRadius = 1e16;
    radius_ =
        std::min(kMaxRadius, radius_ / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * quality - 1.0, 3)));
    decrease_factor_ = 2.0;
  }

  // Reduces the radius after a refused step.
  void Shrink() {
    radius_ /= decrease_factor_;
    decrease_factor_ *= 2.0;
  }

 private:
  double radius_;
  double decrease_factor_ = 2.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_TRUST_REGION_H_
