// Finds the patch of the depth image to which a map point belongs by projecting the point into the
// image, without a search.
#ifndef CERES_ED_SLAM_FRAME_ASSOCIATION_H_
#define CERES_ED_SLAM_FRAME_ASSOCIATION_H_

#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>

#include <algorithm>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A visible point and the patch at its pixel.
struct Association {
  // Index into the visible points.
  int visible = -1;
  const SurfacePatch* patch = nullptr;
  // The signed distance of the point to the plane of the patch, in map units, positive toward the
  // camera.
  double distance = 0.0;
  // The weight in (0, 4]; patches seen at a grazing angle are less certain, and so are those with
  // more noise than others.
  double weight = 1.0;

  // Returns the distance in units of the noise of the patch, times the noise of a typical one.
  double ScaledDistance() const { return distance / patch->relative_noise; }
};

// Options of Associate().
struct AssociationOptions {
  // The largest distance to the plane, in map units, > 0; default 1.
  double max_distance = 1.0;
  // The largest angle between the normals, in degrees, (0, 180]; default 60.
  double max_angle_deg = 60.0;
  // A point that is farther behind the plane of its patch is occluded; map units, default 1.5.
  double occluded_distance = 1.5;
};

// The associations of all visible points.
struct AssociationResult {
  std::vector<Association> matches;
  // Indices of visible points whose patch is far behind them on the same ray: the camera sees
  // through them.
  std::vector<int> seen_through;
  // The number of visible points with a patch at their pixel, and the number of those that are far
  // behind the patch: something else stands before them.
  int measured = 0;
  int occluded = 0;
  // The RobustDeviation() of the matches' scaled distances.
  double deviation = 0.0;

  // Returns the share of the points with a patch that match it, without those that are occluded.
  double MatchedShare() const {
    return static_cast<double>(matches.size()) / std::max(1, measured - occluded);
  }
};

// Associates the points with the patches at their pixels.
AssociationResult Associate(const std::vector<VisiblePoint>& points,
                            const CameraPose& camera_from_map,
                            const ObservedSurface& surface,
                            const AssociationOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_ASSOCIATION_H_
