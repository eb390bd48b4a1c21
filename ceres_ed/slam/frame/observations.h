// What a frame tells of the map.
#ifndef CERES_ED_SLAM_FRAME_OBSERVATIONS_H_
#define CERES_ED_SLAM_FRAME_OBSERVATIONS_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/map/map_points.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map, or between its points, and where it was seen.
struct MapObservation {
  // At rest.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  PointBinding binding;
  // Camera frame, map units.
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
  // Of the observed surface, camera frame, unit length.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double weight = 1.0;
  // Of the map, as it is warped now, camera frame, unit length; zero where nobody asks for it.
  Eigen::Vector3d source_normal = Eigen::Vector3d::Zero();
};

// What a frame has to say of the map.
struct FrameObservations {
  // Against tangent planes.
  std::vector<MapObservation> planes;
  // Of a plane's distance, map units: where the loss gives way.
  double plane_width = 1.0;
  // Point to point.
  std::vector<MapObservation> features;
  double feature_width = 1.0;
  // Where the pose prior holds the camera.
  CameraPose camera_prior;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_OBSERVATIONS_H_
