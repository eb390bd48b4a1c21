// How well a frame determines the motion of the camera, direction by direction.
#ifndef CERES_ED_SLAM_FRAME_MOTION_INFORMATION_H_
#define CERES_ED_SLAM_FRAME_MOTION_INFORMATION_H_

#include <ceres_ed/graph/deformation_state.h>

#include <Eigen/Core>

namespace ceres_ed {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// The information of the rigid alignment of a frame, in units that do not depend on the scene: a
// motion is a rotation about the centre of the scene, as the length that it moves a point at the
// mean radius, and a translation. The strength of a direction is the mean square change of a
// residual when the camera moves by one unit along it (Zhang and Singh, "On degeneracy of
// optimization-based state estimation problems", 2016). It is between 0, where the data say
// nothing, and 1.
struct MotionInformation {
  // In the camera frame and in map units.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 1.0;
  // The strengths of six orthogonal directions, ascending, and the directions, which are columns.
  Vector6d strengths = Vector6d::Zero();
  Matrix6d directions = Matrix6d::Identity();
  // The part of the strengths that the errors of the measured normals produce alone, and the
  // strength beyond it at which a direction is determined by half.
  double noise = 0.0;
  double floor = 0.0;

  // Returns, in [0, 1], how far direction i is determined: the share of a motion along it that is
  // believed.
  double Determined(int i) const;
  // Returns the number of directions that are determined by less than half.
  int NumWeak() const;

  // Returns the coordinates of a motion of the camera (new frame from old frame).
  Vector6d CoordinatesOf(const CameraPose& motion) const;
  // Returns the motion with these coordinates.
  CameraPose MotionOf(const Vector6d& coordinates) const;
  // Returns the part of a motion that the data determine.
  CameraPose DeterminedPart(const CameraPose& motion) const;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_MOTION_INFORMATION_H_
