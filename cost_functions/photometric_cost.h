// Difference in brightness between a warped point and the target there.
#ifndef CERES_ED_COST_FUNCTIONS_PHOTOMETRIC_COST_H_
#define CERES_ED_COST_FUNCTIONS_PHOTOMETRIC_COST_H_

#include <Eigen/Core>

namespace ceres_ed {

// One residual I_t + g . (v~ - v^) - I_s without unit (intensities in [0, 1]): the brightness of
// the target at the warped point v~, to first order around its matched point v^ (coloured ICP, Park
// et al. 2017), beside that of the point itself. I_t is the target's brightness at v^, g its
// gradient along the tangent plane there, per map unit. Target and gradient are in the camera frame
// where there is a camera. A point functor (warped_point_cost.h).
class PhotometricCost {
 public:
  static constexpr int kNumResiduals = 1;

  PhotometricCost(const Eigen::Vector3d& target,
                  double target_intensity,
                  const Eigen::Vector3d& gradient,
                  double source_intensity)
      : gradient_(gradient), offset_(target_intensity - source_intensity - gradient.dot(target)) {}

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
