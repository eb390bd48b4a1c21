#include "ceres_ed/slam/levels/level_covariance.h"

#include <ceres/manifold.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

CameraPose Moved(const CameraPose& pose, const Eigen::Matrix<double, 6, 1>& tangent) {
  CameraPose moved = pose;
  const ceres::EigenQuaternionManifold manifold;
  const Eigen::Vector3d half = tangent.head<3>();
  manifold.Plus(pose.rotation.coeffs().data(), half.data(), moved.rotation.coeffs().data());
  moved.translation += tangent.tail<3>();
  return moved;
}

TEST(MapFromCameraJacobian, IsThatOfTheManifoldByDifferences) {
  CameraPose pose;
  pose.rotation = Eigen::Quaterniond(0.6, -0.3, 0.5, 0.2).normalized();
  pose.translation = {2.0, -1.0, 3.0};
  const Eigen::Matrix<double, 6, 6> jacobian = MapFromCameraJacobian(pose);
  const CameraPose before = pose.Inverse();
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 6; ++k) {
    const CameraPose after = Moved(pose, kStep * Eigen::Matrix<double, 6, 1>::Unit(k)).Inverse();
    Eigen::Matrix<double, 6, 1> change;
    change.head<3>() = (after.translation - before.translation) / kStep;
    // A small rotation in the camera frame that follows that of map_from_camera.
    change.tail<3>() = 2.0 * (before.rotation.conjugate() * after.rotation).vec() / kStep;
    EXPECT_LT((jacobian.col(k) - change).norm(), 1e-5) << k;
  }
}

}  // namespace
}  // namespace ceres_ed
