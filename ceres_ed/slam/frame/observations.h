// The observations of the map in one frame.
#ifndef CERES_ED_SLAM_FRAME_OBSERVATIONS_H_
#define CERES_ED_SLAM_FRAME_OBSERVATIONS_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/map/map_points.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map, or between its points, and the position at which it was seen.
struct MapObservation {
  // The position at rest.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  PointBinding binding;
  // The observed position, in the camera frame and in map units.
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  // The normal of the observed surface, in the camera frame, of unit length.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double weight = 1.0;
  // The normal of the map in its present deformation, in the camera frame, of unit length; zero if
  // it is not needed.
  Eigen::Vector3d source_normal = Eigen::Vector3d::Zero();
};

// All observations of one frame.
struct FrameObservations {
  // Observations against tangent planes.
  std::vector<MapObservation> planes;
  // The width of the loss on the distances to planes, in map units.
  double plane_width = 1.0;
  // Point-to-point observations.
  std::vector<MapObservation> features;
  double feature_width = 1.0;
  // The pose at which the pose prior holds the camera.
  CameraPose camera_prior;
  // Multiplies the weight with which nodes are held where they were, in (0, 1].
  double node_prior_share = 1.0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_OBSERVATIONS_H_
