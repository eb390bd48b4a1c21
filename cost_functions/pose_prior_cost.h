// A prior on the camera pose. It removes the gauge freedom that is left when every node is visible:
// the camera and all nodes can then move together at no cost.
#ifndef CERES_ED_COST_FUNCTIONS_POSE_PRIOR_COST_H_
#define CERES_ED_COST_FUNCTIONS_POSE_PRIOR_COST_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ceres/autodiff_cost_function.h>
#include <cost_functions/node_parameters.h>

namespace ceres_ed {

// The difference between the camera pose and an expected one. It has six residuals:
//   sqrt_information * [ 2 vec(R_prior^-1 R_c) ; T_c - T_prior ]
// Before the multiplication, the upper three are the rotation vector from the prior to the camera,
// in radians to first order (exactly, its length is 2 sin(angle / 2)), in the prior's frame on the
// map side. The lower three are in map units. All are zero at the prior. The quaternions q and -q
// give the same residuals.
// Parameter blocks: R_c (4, x y z w), T_c (3).
class PosePriorCost {
 public:
  static constexpr int kNumResiduals = 6;

  // `rotation` and `translation` are R_prior and T_prior (camera_from_map, map units).
  // `sqrt_information` is an upper-triangular square root of the inverse covariance.
  PosePriorCost(const Eigen::Quaterniond& rotation,
                const Eigen::Vector3d& translation,
                const Eigen::Matrix<double, 6, 6>& sqrt_information)
      : inverse_rotation_(rotation.conjugate()),
        translation_(translation),
        sqrt_information_(sqrt_information) {}

  // Writes the six residuals. Always returns true.
  template <typename T>
  bool operator()(const T* rotation, const T* translation, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> R_c(rotation);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> T_c(translation);
    Eigen::Quaternion<T> delta = inverse_rotation_.cast<T>() * R_c;
    // Of the two quaternions of a rotation, take the one with the smaller angle.
    if (delta.w() < T(0.0)) delta.coeffs() = -delta.coeffs();
    Eigen::Matrix<T, 6, 1> error;
    error << T(2.0) * delta.vec(), T_c - translation_.cast<T>();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>(residuals, 6) = sqrt_information_.cast<T>() * error;
    return true;
  }

  // Returns a new cost function with automatic derivatives. The caller owns it.
  static ceres::CostFunction* Create(const Eigen::Quaterniond& rotation,
                                     const Eigen::Vector3d& translation,
                                     const Eigen::Matrix<double, 6, 6>& sqrt_information) {
    return new ceres::
        AutoDiffCostFunction<PosePriorCost, kNumResiduals, kRotationSize, kTranslationSize>(
            new PosePriorCost(rotation, translation, sqrt_information));
  }

 private:
  Eigen::Quaterniond inverse_rotation_;
  Eigen::Vector3d translation_;
  Eigen::Matrix<double, 6, 6> sqrt_information_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_POSE_PRIOR_COST_H_
