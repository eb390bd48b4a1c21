#include "ceres_ed/io/image_io.h"

namespace ceres_ed {
namespace {

Status NoPictures(const std::string& path) {
  return Status::Error(path + ": this build of ceres_ed has no OpenCV, which reads and writes " +
                       "pictures: install libopencv-imgcodecs-dev and libopencv-video-dev, and " +
                       "build again");
}

}  // namespace

StatusOr<DepthImage> ReadDepthImage(const std::string& path,
                                    double /*units_per_metre*/,
                                    int* /*saturated*/) {
  return NoPictures(path);
}

StatusOr<ColorImage> ReadColorImage(const std::string& path) { return NoPictures(path); }

StatusOr<MaskImage> ReadMaskImage(const std::string& path) { return NoPictures(path); }

Status WriteDepthImage(const std::string& path,
                       const DepthImage& /*depth*/,
                       double /*units_per_metre*/) {
  return NoPictures(path);
}

Status WriteMaskImage(const std::string& path, const MaskImage& /*mask*/) {
  return NoPictures(path);
}

Status WritePointImage(const std::string& path,
                       const PinholeCamera& /*camera*/,
                       const DepthImage& /*depth*/,
                       double /*units_per_metre*/) {
  return NoPictures(path);
}

Status WriteColorImage(const std::string& path, const ColorImage& /*color*/) {
  return NoPictures(path);
}

}  // namespace ceres_ed
