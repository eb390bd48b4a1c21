// The motion of a frame that the camera and the tissue may share.
#ifndef CERES_ED_SLAM_LEVELS_COMMON_MOTION_H_
#define CERES_ED_SLAM_LEVELS_COMMON_MOTION_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/observations.h>
#include <ceres_ed/slam/map/map_points.h>

#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// The standard deviations of the shift and of the turn that a deformation has as a whole, as
// multiples of the root mean square step of the tissue. A breath shifts an organ more than it
// strains it, and turns it less. They are fitted to one simulated sequence, and tested on others
// (scripts/bench_camera_covariance.py).
inline constexpr double kCommonPlaceScale = 1.4;
inline constexpr double kCommonTurnScale = 0.5;

// The translations t_j of some nodes at one moment.
class NodePlaces {
 public:
  // Takes the nodes of these bindings; forgets those that it had.
  void Take(const std::vector<PointBinding>& bindings, const DeformationState& state);

  // Returns the translation of a node, or null if it was not taken.
  const Eigen::Vector3d* Find(int node) const;

 private:
  // In ascending order of the nodes.
  std::vector<std::pair<int, Eigen::Vector3d>> places_;
};

// Returns the covariance of map_from_camera (as LevelCovariance::MapFromCamera()) that the motion
// of the tissue adds in a frame. A deformation seldom leaves the mean place and turn of a body as
// they are, but no depth tells them from a motion of the camera, and the tracker gives them to the
// camera. Let s be the root mean square motion in this frame of the observed places, c their mean
// in the camera frame, and r their root mean square distance from c. The tissue may have moved by
// a s as a whole, and turned about c by b s / r:
//   Cov = J diag(a^2 s^2 I, b^2 s^2 / r^2 I) J^T,   J = [R  R [c]; 0  I],
// with the rotation R of map_from_camera, a = kCommonPlaceScale and b = kCommonTurnScale. `before`
// has the nodes ahead of the frame; others did not move. Zero without observations.
Eigen::Matrix<double, 6, 6> CommonMotionCovariance(const FrameObservations& observations,
                                                   const NodePlaces& before,
                                                   const DeformationState& state);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_COMMON_MOTION_H_
