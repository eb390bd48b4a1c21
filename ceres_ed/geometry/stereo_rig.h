// Two cameras that look at the same scene: what calibrating a stereo endoscope gives.
#ifndef CERES_ED_GEOMETRY_STEREO_RIG_H_
#define CERES_ED_GEOMETRY_STEREO_RIG_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/rigid_transform.h>

#include <array>

namespace ceres_ed {

// A camera whose lens bends the picture.
struct LensCamera {
  // The intrinsics, in pixels of the picture as it is.
  PinholeCamera pinhole;
  // OpenCV's distortion coefficients k1 k2 p1 p2 k3 k4 k5 k6, no unit; all zero for none.
  std::array<double, 8> distortion{};
};

// A stereo camera.
struct StereoRig {
  LensCamera left;
  LensCamera right;
  // point_in_right = right_from_left * point_in_left, metres. In a rectified rig it has no
  // rotation, and its translation is (-baseline, 0, 0).
  RigidTransform right_from_left;
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_STEREO_RIG_H_
