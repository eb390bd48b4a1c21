#include "ceres_ed/io/calibration/llff_poses.h"

#include <ceres_ed/io/npy_file.h>

#include <cmath>
#include <cstddef>
#include <sstream>

namespace ceres_ed {
namespace {

constexpr std::size_t kNumbersPerFrame = 17;

// Returns whether a principal point is where that of a camera may be.
bool IsNearTheMiddle(double center, int size) {
  constexpr double kLowest = 0.3;
  constexpr double kHighest = 0.7;
  return center > kLowest * size && center < kHighest * size;
}

}  // namespace

StatusOr<LlffCamera> ReadLlffCamera(const std::string& path, int width, int height) {
  const StatusOr<NpyArray> array = ReadNpyFile(path);
  if (!array.ok()) return array.status();
  if (array->shape.size() != 2 || array->shape[1] != kNumbersPerFrame || array->shape[0] == 0) {
    return Status::Error(path + ": the shape is " + array->ShapeText() +
                         ", expected (frames, 17): poses and bounds as LLFF writes them");
  }
  LlffCamera camera;
  camera.num_frames = static_cast<int>(array->shape[0]);
  const double first = array->values[4];
  const double second = array->values[9];
  camera.focal = array->values[14];
  if (!(camera.focal > 0.0) || !std::isfinite(camera.focal)) {
    return Status::Error(path + ": the focal length of the first frame is " +
                         std::to_string(camera.focal) + ", expected a positive number of pixels");
  }
  std::ostringstream remark;
  if (std::abs(first - height) <= 1.0 && std::abs(second - width) <= 1.0) return camera;
  if (IsNearTheMiddle(first, height) && IsNearTheMiddle(second, width)) {
    camera.has_center = true;
    camera.cy = first;
    camera.cx = second;
    remark << path << ": [" << first << ", " << second << ", " << camera.focal
           << "] stand where height, width and focal length belong, and the pictures have " << width
           << " x " << height << " pixels: taken as cy, cx and focal length";
    camera.remarks.push_back(remark.str());
    return camera;
  }
  // The pictures were scaled, and the file was not.
  const double scale = width / second;
  if (std::abs(first * scale - height) <= 1.0 && scale > 0.0) {
    remark << path << ": is for pictures of " << second << " x " << first
           << " pixels, and these have " << width << " x " << height
           << ": the focal length is scaled by " << scale;
    camera.focal *= scale;
    camera.remarks.push_back(remark.str());
    return camera;
  }
  remark << path << ": height and width are " << first << " and " << second
         << ", expected those of the pictures, " << height << " and " << width
         << " (or cy and cx, about half of them)";
  return Status::Error(remark.str());
}

}  // namespace ceres_ed
