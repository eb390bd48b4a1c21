// Tracks the camera alone, by rigid alignment of the map in its present deformation with the depth
// image.
#ifndef CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_
#define CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/frame/association.h>
#include <ceres_ed/slam/frame/motion_information.h>
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
  // In [0, 1].
  double weight = 1.0;
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
  // The residual at which a match has no weight, in map units, > 0: in the first step, and the
  // least one of later steps, each of which halves the width. The wide start finds the motion of
  // the whole scene; a width from the spread alone would take that of the largest still part.
  // Defaults 1 and 0.1.
  double first_width = 1.0;
  double least_width = 0.1;
  // The strength of a direction (MotionInformation), beyond what the errors of the normals produce,
  // at which half of its motion is believed, > 0. Default 1e-3.
  double strength_floor = 1e-3;
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
  MotionInformation information;
};

// Returns how badly a pose explains a frame, in [0, 1]: the mean of min(1, d^2) over the points
// that have a patch at their pixel, where d is the distance from its plane in map units; 1 if there
// are none.
double Misfit(const std::vector<VisiblePoint>& points,
              const CameraPose& camera_from_map,
              const ObservedSurface& surface);

// Returns the pose that moves `points` onto the surface. It uses the Gauss-Newton method on robust
// (Tukey) point-to-plane distances, which are associated again in each step, and on the distances
// of `matches`. Along directions that the data do not determine the pose stays at `start`.
CameraTrackerResult TrackCamera(const std::vector<VisiblePoint>& points,
                                const std::vector<PointMatch>& matches,
                                const ObservedSurface& surface,
                                const CameraPose& start,
                                const CameraTrackerOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_CAMERA_TRACKER_H_
