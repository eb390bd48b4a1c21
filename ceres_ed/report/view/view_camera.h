// From where a scene is looked at first.
#ifndef CERES_ED_REPORT_VIEW_VIEW_CAMERA_H_
#define CERES_ED_REPORT_VIEW_VIEW_CAMERA_H_

#include <Eigen/Core>

namespace ceres_ed {

struct Scene;

// The angle of view of pages and pictures from top to bottom, in degrees.
inline constexpr double kViewAngleDeg = 30.0;

struct ViewCamera {
  // Unit vectors: from the centre of the scene to the eye, and upwards.
  Eigen::Vector3d from = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
};

// Returns the camera of a scene, if it has none of its own. If a surface that stands still, such as
// a target, shows one side only (its normals have a mean of more than 0.3), this side is seen,
// turned by 50 degrees so that something of the other side is seen, too. Otherwise the scene is
// seen from the front, right and above. y is upwards, or z if the eye is on the y axis.
ViewCamera ChooseCamera(const Scene& scene);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_VIEW_CAMERA_H_
