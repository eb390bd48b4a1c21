// Rotation and translation.
#ifndef CERES_ED_GEOMETRY_RIGID_TRANSFORM_H_
#define CERES_ED_GEOMETRY_RIGID_TRANSFORM_H_

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {

// A rigid transform b_from_a: point_in_b = rotation * point_in_a + translation. It is the identity
// by default.
struct RigidTransform {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  // In the unit of the points.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  // Returns the point in frame b.
  Eigen::Vector3d operator*(const Eigen::Vector3d& point_in_a) const {
    return rotation * point_in_a + translation;
  }
  // Returns the point in frame a.
  Eigen::Vector3d ApplyInverse(const Eigen::Vector3d& point_in_b) const {
    return rotation.conjugate() * (point_in_b - translation);
  }
  // Returns c_from_a for this c_from_b and `b_from_a`.
  RigidTransform operator*(const RigidTransform& b_from_a) const {
    return {(rotation * b_from_a.rotation).normalized(), *this * b_from_a.translation};
  }
  // Returns a_from_b.
  RigidTransform Inverse() const {
    const Eigen::Quaterniond back = rotation.conjugate();
    return {back, -(back * translation)};
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_RIGID_TRANSFORM_H_
