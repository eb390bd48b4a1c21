// The trust region of Levenberg and Marquardt.
#ifndef CERES_ED_SOLVER_TRUST_REGION_H_
#define CERES_ED_SOLVER_TRUST_REGION_H_

#include <algorithm>
#include <cmath>

namespace ceres_ed {

// The size of the trust region: a step is damped by the diagonal of the normal equations over the
// radius. The rules are those of Nielsen, "Damping parameter in
// Marquardt's method" (1999), with the defaults of Ceres for what SolverOptions leaves open.
class TrustRegion {
 public:
  // A solve ends after this many steps in a row where a residual can't be evaluated.
  static constexpr int kMaxConsecutiveInvalidSteps = 5;

  // `radius` > 0.
  explicit TrustRegion(double radius) : radius_(radius) {}

  double radius() const { return radius_; }
  bool IsTooSmall() const { return radius_ < 1e-32; }

  // Whether a step is worth taking whose decrease of the cost is `quality` times the one that the
  // linearised problem promised.
  static bool Accepts(double quality) { return quality > 1e-3; }

  // After a step that was taken.
  void Grow(double quality) {
    constexpr double kMaxRadius = 1e16;
    radius_ =
        std::min(kMaxRadius, radius_ / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * quality - 1.0, 3)));
    decrease_factor_ = 2.0;
  }

  // After a step that was not taken.
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
