// The camera that a rectification makes of two.
#ifndef CERES_ED_IO_CALIBRATION_RECTIFY_RIG_H_
#define CERES_ED_IO_CALIBRATION_RECTIFY_RIG_H_

#include <ceres_ed/geometry/stereo_rig.h>

namespace ceres_ed {

// Returns the rectified cameras of `rig`, whose pictures have a size, as OpenCV's stereoRectify()
// gives them with the principal points at the same place and alpha = 0. Data sets that come
// rectified were made so.
StereoRig RectifyRig(const StereoRig& rig);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CALIBRATION_RECTIFY_RIG_H_
