// The distance of a warped point from the tangent plane of the target.
#ifndef CERES_ED_COST_FUNCTIONS_POINT_TO_PLANE_COST_H_
#define CERES_ED_COST_FUNCTIONS_POINT_TO_PLANE_COST_H_

#include <Eigen/Core>

namespace ceres_ed {

// The signed distance of the warped point from a plane. It has one residual, in map units:
//   n . (v~ - v^)
// The plane goes through the target point v^ and has the unit normal n (the data term of depth
// tracking, section IV of the paper). If there is a camera, the target and the normal are in the
// camera frame. If the normal is zero, the residual is zero. This is a point functor (see
// warped_point_cost.h).
class PointToPlaneCost {
 public:
  static constexpr int kNumResiduals = 1;

  // `target` is v^ in map units; `normal` is n, of length 1 or 0.
  PointToPlaneCost(const Eigen::Vector3d& target, const Eigen::Vector3d& normal)
      : normal_(normal), offset_(normal.dot(target)) {}

  // Writes the residual. Always returns true.
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
