// Distance of a warped point to the tangent plane of the target.
#ifndef CERES_ED_COST_FUNCTIONS_POINT_TO_PLANE_COST_H_
#define CERES_ED_COST_FUNCTIONS_POINT_TO_PLANE_COST_H_

#include <Eigen/Core>

namespace ceres_ed {

// One residual n . (v~ - v^) in map units: the warped point's signed distance to the plane through
// the target point v^ with unit normal n (the data term of depth tracking, section IV of the
// paper). Target and normal are in the camera frame where there is a camera. A point functor
// (warped_point_cost.h). A zero normal makes a zero residual.
class PointToPlaneCost {
 public:
  static constexpr int kNumResiduals = 1;

  PointToPlaneCost(const Eigen::Vector3d& target, const Eigen::Vector3d& normal)
      : normal_(normal), offset_(normal.dot(target)) {}

  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] =
        T(normal_[0]) * point[0] + T(normal_[1]) * point[1] + T(normal_[2]) * point[2] - T(offset_);
    return true;
  }

 private:
  Eigen::Vector3d normal_;
  double offset_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_COST_FUNCTIONS_POINT_TO_PLANE_COST_H_
