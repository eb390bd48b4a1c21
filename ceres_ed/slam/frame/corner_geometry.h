// Where corners of the picture lie on the observed surface, and where the map expects them.
#ifndef CERES_ED_SLAM_FRAME_CORNER_GEOMETRY_H_
#define CERES_ED_SLAM_FRAME_CORNER_GEOMETRY_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/slam/frame/corner_store.h>
#include <ceres_ed/slam/frame/observed_surface.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <Eigen/Core>

namespace ceres_ed {

// A corner as the map and a camera predict it.
struct CornerPrediction {
  Eigen::Vector3d in_camera = Eigen::Vector3d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // Maps offsets in the picture of the template to offsets in the present one.
  Eigen::Matrix2d now_from_then = Eigen::Matrix2d::Identity();
  // Whether the corner is before the camera and turned toward it, at a similar scale.
  bool comparable = false;
};

// Predicts where a corner is in the picture of a camera, and how it looks there.
CornerPrediction PredictCorner(const Corner& corner,
                               const DeformableMap& map,
                               const CameraPose& camera_from_map,
                               const PinholeCamera& camera);

// Computes where the ray of a pixel intersects the plane of its patch. Returns false if there is no
// patch.
bool OnSurface(const ObservedSurface& surface,
               const Eigen::Vector2d& pixel,
               Eigen::Vector3d* point);

// Returns how the point where the ray of a pixel meets the plane through `point` changes with the
// pixel: for the ray r(u, v) of depth 1, P = r (n . point) / (n . r).
Eigen::Matrix<double, 3, 2> PlaneFromPixel(const PinholeCamera& camera,
                                           const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& normal);

// Returns the pixels that have a patch and are at least `margin` pixels from the border.
MaskImage Measured(const ObservedSurface& surface, int margin = 0);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_CORNER_GEOMETRY_H_
