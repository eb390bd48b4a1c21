// Point-to-point distance of a warped point to a target point.
#ifndef CERES_ED_COST_FUNCTIONS_POINT_TO_POINT_COST_H_
#define CERES_ED_COST_FUNCTIONS_POINT_TO_POINT_COST_H_

#include <Eigen/Core>

namespace ceres_ed {

// Three residuals v~ - v^ (Eq. 7) in map units: the warped point minus its target, both in the
// camera frame where there is a camera. A point functor (warped_point_cost.h).
class PointToPointCost {
 public:
  static constexpr int kNumResiduals = 3;

  explicit PointToPointCost(const Eigen::Vector3d& target) : target_(target) {}

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
