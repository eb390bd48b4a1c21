// poses_bounds.npy: cameras in the form of LLFF, as EndoNeRF and its converters write them.
#ifndef CERES_ED_IO_CALIBRATION_LLFF_POSES_H_
#define CERES_ED_IO_CALIBRATION_LLFF_POSES_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// The camera of a recording. Only what EndoNeRF uses is read: its poses are the identity.
struct LlffCamera {
  // The focal length in pixels.
  double focal = 0.0;
  // The principal point in pixels. LLFF has none: it is the middle of the picture, unless
  // `has_center`.
  bool has_center = false;
  double cx = 0.0;
  double cy = 0.0;
  int num_frames = 0;
  // Sentences about what was assumed.
  std::vector<std::string> remarks;
};

// Reads a file with 17 numbers a frame: 3 x 5 numbers, row by row, whose last column is height,
// width and focal length, and two bounds. `width` and `height` are those of the pictures. Some
// converters write cy, cx and the focal length in place of height, width and focal length; where
// the numbers are about half of the picture's size they are taken as such, and a remark says so.
// Errors name the file: it is no such array, the focal length is not positive, or the size is
// neither that of the picture nor its half.
StatusOr<LlffCamera> ReadLlffCamera(const std::string& path, int width, int height);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CALIBRATION_LLFF_POSES_H_
