// What the library does without OpenCV instead of comparing pictures: it says so.
#include <ceres_ed/stereo/pair_check.h>
#include <ceres_ed/stereo/stereo_matcher.h>

#include <glog/logging.h>

namespace ceres_ed {

struct Rectification::Maps {};
Rectification::~Rectification() = default;

RectifiedPair Rectification::Apply(const ColorImage&, const ColorImage&, const MaskImage&) const {
  LOG(FATAL) << "there is no rectification without OpenCV";
}

StatusOr<std::unique_ptr<StereoMatcher>> StereoMatcher::Create(const StereoRig&,
                                                               bool,
                                                               const StereoOptions&) {
  return Status::Error(
      "this build of ceres_ed has no OpenCV, expected one that has: stereo pictures "
      "can't be compared");
}

DepthNoise StereoMatcher::noise() const { return {}; }

StereoDepth StereoMatcher::Match(const ColorImage&, const ColorImage&, const MaskImage&) const {
  LOG(FATAL) << "there is no matching without OpenCV";
}

GrayImage GrayOf(const ColorImage& color) { return GrayImage(color.width(), color.height()); }

PairFindings CheckPair(const GrayImage&, const GrayImage&, const MaskImage&, double) { return {}; }

}  // namespace ceres_ed
