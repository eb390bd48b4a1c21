// The difference in brightness between a warped point and the target.
#ifndef CERES_ED_COST_FUNCTIONS_PHOTOMETRIC_COST_H_
#define CERES_ED_COST_FUNCTIONS_PHOTOMETRIC_COST_H_

#include <Eigen/Core>

namespace ceres_ed {

// The photometric error of a warped point. It has one residual, without a unit (intensities are in
// [0, 1]):
//   I_t + g . (v~ - v^) - I_s
// This is the target's brightness at the warped point v~, to first order around the matched point
// v^ (coloured ICP, Park et al. 2017), minus the brightness I_s of the point itself. I_t is the
// target's brightness at v^, and g is its gradient there along the tangent plane, per map unit. If
// there is a camera, the target and the gradient are in the camera frame. This is a point functor
// (see warped_point_cost.h).
class PhotometricCost {
 public:
  static constexpr int kNumResiduals = 1;

  // `target` is v^ in map units, `target_intensity` is I_t, `gradient` is g and `source_intensity`
  // is I_s.
  PhotometricCost(const Eigen::Vector3d& target,
                  double target_intensity,
                  const Eigen::Vector3d& gradient,
                  double source_intensity)
      : gradient_(gradient), offset_(target_intensity - source_intensity - gradient.dot(target)) {}

  // Writes the residual. Always returns true.
  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = T(gradient_[0]) * point[0] + T(gradient_[1]) * point[1] +
                  T(gradient_[2]) * point[2] + T(offset_);
    return true;
  }

 private:
  Eigen::Vector3d gradient_;
  double offset_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_PHOTOMETRIC_COST_H_
