// Back-projection: which patch of the depth image a map point belongs to, without any search.
#ifndef CERES_ED_SLAM_FRAME_ASSOCIATION_H_
#define CERES_ED_SLAM_FRAME_ASSOCIATION_H_

#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/frame/visibility.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A visible point and the patch behind its pixel.
struct Association {
  // Index into the visible points.
  int visible = -1;
  const SurfacePatch* patch = nullptr;
  // Signed distance of the point to the patch's plane, map units; positive toward the camera.
  double distance = 0.0;
  // In (0, 1]: grazing patches are less certain.
  double weight = 1.0;
};

struct AssociationOptions {
  // Farthest distance to the plane, map units, > 0.
  double max_distance = 1.0;
  // Largest angle between the normals, degrees, (0, 180].
  double max_angle_deg = 60.0;
};

// What looking up all visible points gave.
struct AssociationResult {
  std::vector<Association> matches;
  // Indices of visible points with a patch well behind them, camera and patch on one ray: the
  // camera sees through them.
  std::vector<int> seen_through;
  // Visible points with any patch at their pixel.
  int measured = 0;
  // The RobustDeviation() of the matches' distances.
  double deviation = 0.0;
};

// Associates by the pixels in `points`.
AssociationResult Associate(const std::vector<VisiblePoint>& points,
                            const CameraPose& camera_from_map,
                            const ObservedSurface& surface,
                            const AssociationOptions& options);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_ASSOCIATION_H_
