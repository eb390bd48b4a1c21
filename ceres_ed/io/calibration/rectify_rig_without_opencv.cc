#include "ceres_ed/io/calibration/rectify_rig.h"

namespace ceres_ed {

// Without OpenCV no picture can be read, so that nobody comes here.
StereoRig RectifyRig(const StereoRig& rig) { return rig; }

}  // namespace ceres_ed
