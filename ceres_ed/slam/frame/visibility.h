// Determines which points of the map the camera sees.
#ifndef CERES_ED_SLAM_FRAME_VISIBILITY_H_
#define CERES_ED_SLAM_FRAME_VISIBILITY_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/z_buffer.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A point in view, in the present deformation of the map.
struct VisiblePoint {
  int slot = -1;
  Eigen::Vector3d in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// Options of FindVisible().
struct VisibilityOptions {
  // The width of a cell of the z-buffer, which must be at least the distance of two points; map
  // units, > 0, default 0.3.
  double cell_size = 0.3;
  // A point is hidden if it is this far behind the nearest point of its cell; map units, > 0,
  // default 0.5.
  double depth_tolerance = 0.5;
  // Points whose normal is turned farther away from the camera are not in view; degrees, default
  // 85.
  double max_view_angle_deg = 85.0;
};

// Determines which places the map hides from a camera, with a z-buffer of the map's points.
class MapOcclusion {
 public:
  // `in_picture` contains the points of the map whose pixels are in the picture, whether they are
  // visible or not.
  MapOcclusion(const std::vector<VisiblePoint>& in_picture,
               const PinholeCamera& camera,
               const VisibilityOptions& options);

  // Returns whether a place faces the camera and is not behind the map. `pixel` is its pixel; the
  // other arguments are in the camera frame and in map units.
  bool Sees(const Eigen::Vector3d& place,
            const Eigen::Vector3d& normal,
            const Eigen::Vector2d& pixel) const;

 private:
  PinholeCamera camera_;
  VisibilityOptions options_;
  double min_cosine_;
  ZBuffer<double> nearest_;
};

// Returns the points of the map whose pixels are in the picture, node by node. Only points of nodes
// near the view are visited.
std::vector<VisiblePoint> PointsInPicture(const DeformableMap& map,
                                          const CameraPose& camera_from_map,
                                          const PinholeCamera& camera);

// Returns whether a pixel is in the picture.
bool InPicture(const PinholeCamera& camera, const Eigen::Vector2d& pixel);

// Returns the points in view, node by node: they are in the picture, face the camera, and are not
// behind the warped map.
std::vector<VisiblePoint> FindVisible(const DeformableMap& map,
                                      const CameraPose& camera_from_map,
                                      const PinholeCamera& camera,
                                      const VisibilityOptions& options);

// Updates the points after nodes or camera have moved.
void UpdateVisible(const DeformableMap& map,
                   const CameraPose& camera_from_map,
                   const PinholeCamera& camera,
                   std::vector<VisiblePoint>* points);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_VISIBILITY_H_
