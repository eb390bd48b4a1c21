// The motion of a frame that the camera and the tissue may share.
#ifndef CERES_ED_SLAM_LEVELS_COMMON_MOTION_H_
#define CERES_ED_SLAM_LEVELS_COMMON_MOTION_H_

#include <ceres_ed/slam/frame/observations.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The standard deviation of the rigid motion that a deformation has as a whole, as a multiple of
// the root mean square step of the tissue. It is fitted to simulated sequences
// (scripts/bench_camera_covariance.py).
inline constexpr double kCommonMotionScale = 1.0;

// Returns the covariance of map_from_camera (as LevelCovariance::MapFromCamera()) that the motion
// of the tissue adds in a frame. A deformation seldom leaves the mean place and turn of a body as
// they are, but no depth tells them from a motion of the camera, and the tracker gives them to the
// camera. Let s be the root mean square motion in this frame of the observed places, c their mean
// in the camera frame, and r their root mean square distance from c. The tissue may have moved by s
// as a whole, and turned about c by s / r:
//   Cov = k^2 J diag(s^2 I, s^2 / r^2 I) J^T,   J = [R  R [c]; 0  I],
// with the rotation R of map_from_camera and k = kCommonMotionScale. `nodes_before` has the
// translations of the nodes before the frame; nodes that are newer did not move. Zero without
// observations.
Eigen::Matrix<double, 6, 6> CommonMotionCovariance(const FrameObservations& observations,
                                                   const std::vector<Eigen::Vector3d>& nodes_before,
                                                   const DeformableMap& map);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_COMMON_MOTION_H_
