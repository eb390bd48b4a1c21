// Tracks the camera alone, by rigid alignment of the map in its present deformation with the depth
// image.
#ifndef CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_
#define CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/association.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point of the map in its present deformation (map frame), and the position at which it was seen
// (camera frame).
struct PointMatch {
  Eigen::Vector3d in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
};

// Options of TrackCamera().
struct CameraTrackerOptions {
  // The largest number of steps; default 10.
  int max_iterations = 10;
  // The largest number of map points that are used, >= 6; if there are more, they are chosen
  // evenly. Default 3000.
  int max_points = 3000;
  // The options of the association in each step.
  AssociationOptions association;
  // The weight of a point match relative to a point-to-plane match, >= 0; default 4.
  double match_weight = 4.0;
  // The damping of each step, relative to the data, >= 0; default 1e-3. Directions that the data do
  // not determine do not change.
  double damping = 1e-3;
};

// The pose found by TrackCamera(), and how well the points agree with it.
struct CameraTrackerResult {
  CameraPose camera_from_map;
  // The number of points with a patch at their pixel, and the number of those within three
  // deviations of the patch.
  int measured = 0;
  int inliers = 0;
  // The spread of the distances to the planes, in map units.
  double deviation = 0.0;
};

// Returns the pose that moves `points` onto the surface. It uses the Gauss-Newton method on robust
// (Tukey) point-to-plane distances, which are associated again in each step, and on the distances
// of `matches`.
CameraTrackerResult TrackCamera(const std::vector<VisiblePoint>& points,
                                const std::vector<PointMatch>& matches,
                                const ObservedSurface& surface,
                                const CameraPose& start,
                                const CameraTrackerOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_
