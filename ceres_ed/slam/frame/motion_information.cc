#include "ceres_ed/slam/frame/motion_information.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace ceres_ed {

double MotionInformation::Determined(int i) const {
  const double strength = std::max(0.0, strengths[i] - noise);
  const double sum = strength * strength + floor * floor;
  return sum > 0.0 ? strength * strength / sum : 0.0;
}

int MotionInformation::NumWeak() const {
  int count = 0;
  for (int i = 0; i < 6; ++i) count += Determined(i) < 0.5 ? 1 : 0;
  return count;
}

// A motion x' = R x + t is x' = R (x - center) + center + tau.
Vector6d MotionInformation::CoordinatesOf(const CameraPose& motion) const {
  const Eigen::AngleAxisd turn(motion.rotation);
  Vector6d coordinates;
  coordinates << radius * turn.angle() * turn.axis(), motion * center - center;
  return coordinates;
}

CameraPose MotionInformation::MotionOf(const Vector6d& coordinates) const {
  const Eigen::Vector3d omega = coordinates.head<3>() / radius;
  const double angle = omega.norm();
  CameraPose motion;
  if (angle > 0.0) motion.rotation = Eigen::AngleAxisd(angle, omega / angle);
  motion.translation = center + coordinates.tail<3>() - motion.rotation * center;
  return motion;
}

CameraPose MotionInformation::DeterminedPart(const CameraPose& motion) const {
  Vector6d along = directions.transpose() * CoordinatesOf(motion);
  for (int i = 0; i < 6; ++i) along[i] *= Determined(i);
  return MotionOf(directions * along);
}

}  // namespace ceres_ed
