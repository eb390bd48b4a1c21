// How well Level I of a frame determines the camera and the points of the map.
#ifndef CERES_ED_SLAM_LEVELS_LEVEL_COVARIANCE_H_
#define CERES_ED_SLAM_LEVELS_LEVEL_COVARIANCE_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/levels/level_window.h>
#include <ceres_ed/slam/map/map_points.h>
#include <ceres_ed/solver/covariance/state_covariance.h>

#include <memory>
#include <unordered_map>
#include <utility>

#include <Eigen/Core>

namespace ceres_ed {

// Returns how map_from_camera changes (its translation in the map frame, then a rotation vector in
// the camera frame: R exp([r])) with the six tangent values of `camera_from_map`: half a rotation
// vector in the camera frame (ceres::EigenQuaternionManifold), then the translation.
Eigen::Matrix<double, 6, 6> MapFromCameraJacobian(const CameraPose& camera_from_map);

// The covariances of a frame, in map units and radians. They count what the depth and the corners
// of this frame say, with the priors of the levels: the noise is measured from the distances to the
// planes, and all planes of a node count as one measurement, because neighbouring pixels err
// together. They do not count what earlier frames have left in the map, wrong associations, or the
// drift of the camera since the first frame.
class LevelCovariance {
 public:
  using Matrix6d = Eigen::Matrix<double, 6, 6>;

  LevelCovariance(std::unique_ptr<const LevelWindow> window, StateCovariance nodes);

  // Returns the covariance of map_from_camera: its translation in the map frame, then a rotation
  // vector in the camera frame (R exp([r])). It is zero if the camera was given, and NaN if nothing
  // determines it.
  Matrix6d MapFromCamera() const;

  // Returns the covariance of the point of the map whose place at rest is `position`, in the map
  // frame. NaN if Level I did not move all of its nodes, or if nothing determines one of them.
  Eigen::Matrix3d Point(const Eigen::Vector3d& position, const PointBinding& binding) const;

 private:
  // The graph of the window must outlive the covariance of its nodes.
  std::unique_ptr<const LevelWindow> window_;
  StateCovariance nodes_;
  // The places of the variable nodes in the window, by their number in the map.
  std::unordered_map<int, int> local_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_LEVELS_LEVEL_COVARIANCE_H_
