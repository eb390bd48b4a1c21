// The distance of a warped point from a target point.
#ifndef CERES_ED_COST_FUNCTIONS_POINT_TO_POINT_COST_H_
#define CERES_ED_COST_FUNCTIONS_POINT_TO_POINT_COST_H_

#include <Eigen/Core>

namespace ceres_ed {

// The warped point minus its target (Eq. 7). It has three residuals, in map units:
//   v~ - v^
// If there is a camera, both points are in the camera frame. This is a point functor (see
// warped_point_cost.h).
class PointToPointCost {
 public:
  static constexpr int kNumResiduals = 3;

  // `target` is v^ in map units.
  explicit PointToPointCost(const Eigen::Vector3d& target) : target_(target) {}

  // Writes the three residuals. Always returns true.
  template <typename T>
  bool operator()(const T* point, T* residuals) const {
    for (int i = 0; i < 3; ++i) residuals[i] = point[i] - T(target_[i]);
    return true;
  }

 private:
  Eigen::Vector3d target_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_POINT_TO_POINT_COST_H_
