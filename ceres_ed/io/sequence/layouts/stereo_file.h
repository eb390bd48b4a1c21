// stereo.txt: the two cameras of rectified stereo pictures.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_STEREO_FILE_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_STEREO_FILE_H_

#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads the eight numbers `fx fy cx_left cx_right cy width height baseline_metres` with # comments,
// on one line or several, and returns the rectified rig (stereo_rig.h). Errors name file, line,
// value and what was expected. It is an error if a number is not finite, a focal length or the
// baseline is not positive, a size is not a whole number of pixels, or there are fewer or more
// numbers.
StatusOr<StereoRig> ReadStereoFile(const std::string& path);

// Writes a rectified rig, whose numbers are read back as the same doubles. Returns an error if it
// can't be written or if ReadStereoFile() would refuse a number.
Status WriteStereoFile(const std::string& path, const StereoRig& rig);

// Returns the rectified rig of two cameras that differ in cx only. `left` is the left camera;
// `baseline` is in metres.
StereoRig MakeRectifiedRig(const PinholeCamera& left, double cx_right, double baseline);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_STEREO_FILE_H_
