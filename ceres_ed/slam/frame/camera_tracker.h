// The camera by itself: rigid alignment of the map, as it is deformed now, to the depth image.
#ifndef CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_
#define CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/association.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map (map frame, as deformed now) seen at a place (camera frame).
struct PointMatch {
  Eigen::Vector3d in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
};

struct CameraTrackerOptions {
  int max_iterations = 10;
  // Points of the map that are used; evenly chosen among more, >= 6.
  int max_points = 3000;
  AssociationOptions association;
  // Weight of one point match against one point-to-plane match, >= 0.
  double match_weight = 4.0;
  // Of each step, relative to the data: leaves alone what they leave open, >= 0.
  double damping = 1e-3;
};

struct CameraTrackerResult {
  CameraPose camera_from_map;
  // The points with a patch at their pixel, and those of them within three deviations of it.
  int measured = 0;
  int inliers = 0;
  // Spread of the distances to the planes, map units.
  double deviation = 0.0;
};

// Returns the pose that brings `points` onto the surface: Gauss-Newton on robust (Tukey)
// point-to-plane distances, associated anew at each step, and on the distances of the matches.
CameraTrackerResult TrackCamera(const std::vector<VisiblePoint>& points,
                                const std::vector<PointMatch>& matches,
                                const ObservedSurface& surface,
                                const CameraPose& start,
                                const CameraTrackerOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_
