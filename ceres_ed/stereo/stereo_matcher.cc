#include "ceres_ed/stereo/stereo_matcher.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Disparities of less than this many standard deviations cannot be told from infinity.
constexpr double kLeastDisparity = 4.0;
// Highlights are left out with the pixels next to them.
constexpr int kHighlightMargin = 2;

// Sets the mask of pixels to zero where a channel is as large as `level`.
void LeaveOutHighlights(const ColorImage& color, int level, MaskImage* mask) {
  if (level > 255) return;
  MaskImage dark(color.width(), color.height(), 255);
  for (std::size_t i = 0; i < color.pixels().size(); ++i) {
    const auto& rgb = color.pixels()[i];
    if (std::max({rgb[0], rgb[1], rgb[2]}) >= level) dark.pixels()[i] = 0;
  }
  Shrink(kHighlightMargin, &dark);
  for (std::size_t i = 0; i < dark.pixels().size(); ++i) {
    if (dark.pixels()[i] == 0) mask->pixels()[i] = 0;
  }
}

}  // namespace

GrayImage GrayOf(const ColorImage& color) {
  GrayImage gray(color.width(), color.height());
  for (std::size_t i = 0; i < color.pixels().size(); ++i) {
    const auto& rgb = color.pixels()[i];
    gray.pixels()[i] =
        static_cast<std::uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
  }
  return gray;
}

StatusOr<std::unique_ptr<StereoMatcher>> StereoMatcher::Create(const StereoRig& rig,
                                                               bool is_rectified,
                                                               const StereoOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) return Status::Error(error);
  StatusOr<std::unique_ptr<Rectification>> rectification = Rectification::Create(rig, is_rectified);
  if (!rectification.ok()) return rectification.status();
  return std::unique_ptr<StereoMatcher>(new StereoMatcher(*std::move(rectification), options));
}

DepthNoise StereoMatcher::noise() const {
  DepthNoise noise;
  noise.quadratic = options_.disparity_sigma / rig().FocalTimesBaseline();
  return noise;
}

DisparityRange StereoMatcher::RangeOf(const GrayImage& left,
                                      const GrayImage& right,
                                      const MaskImage& left_mask) const {
  const int infinity = static_cast<int>(std::floor(rig().offset));
  DisparityRange found{infinity, std::max(1, left.width() / 4)};
  if (options_.max_disparity == 0) {
    const DisparityRange range = FindRange(left, right, left_mask, rig().offset);
    if (range.count > 0) found = range;
  } else {
    found = {infinity + options_.min_disparity,
             options_.max_disparity - options_.min_disparity + 1};
  }
  if (options_.min_disparity > 0) {
    const int end = found.min + found.count;
    found.min = infinity + options_.min_disparity;
    found.count = std::max(1, end - found.min);
  }
  return found;
}

void StereoMatcher::Polish(const GrayImage& left,
                           const GrayImage& right,
                           DisparityImage* disparity) const {
  if (options_.refine) RefineDisparity(left, right, disparity);
  if (options_.correlation > -1.0) LeaveOutUnlike(left, right, options_.correlation, disparity);
  if (options_.edge_margin > 0) LeaveOutEdges(options_.edge_margin, disparity);
}

DisparityImage StereoMatcher::Compare(const GrayImage& left,
                                      const GrayImage& right,
                                      const DisparityRange& range,
                                      int scale) const {
  if (scale > 1 && left.width() >= 2 && left.height() >= 2) {
    const int min = static_cast<int>(std::floor(0.5 * range.min));
    const DisparityImage half =
        Compare(HalfSize(left), HalfSize(right), {min, range.count / 2 + 2}, scale / 2);
    return DoubleSize(half, left.width(), left.height());
  }
  DisparityImage disparity = MatchRows(left, right, range, options_);
  Polish(left, right, &disparity);
  if (options_.smoothing > 0) SmoothDisparity(options_.smoothing, &disparity);
  return disparity;
}

int StereoMatcher::Scale() const {
  constexpr int kLargestWidth = 800;
  constexpr int kLargestScale = 4;
  if (options_.reduce > 0) return options_.reduce;
  int scale = 1;
  while (scale < kLargestScale && camera().width > scale * kLargestWidth) scale *= 2;
  return scale;
}

StereoDepth StereoMatcher::Match(const ColorImage& left,
                                 const ColorImage& right,
                                 const MaskImage& mask) const {
  const PinholeCamera& camera = this->camera();
  CHECK(left.width() == camera.width && left.height() == camera.height);
  CHECK(right.width() == camera.width && right.height() == camera.height);
  RectifiedPair pair = rectification_->Apply(left, right, mask);
  StereoDepth result;
  result.mask = pair.left_mask;
  LeaveOutHighlights(pair.left, options_.highlight, &pair.left_mask);
  LeaveOutHighlights(pair.right, options_.highlight, &pair.right_mask);
  const GrayImage left_gray = GrayOf(pair.left), right_gray = GrayOf(pair.right);
  result.range = RangeOf(left_gray, right_gray, pair.left_mask);
  const DisparityImage disparity = Compare(left_gray, right_gray, result.range, Scale());

  const double least = kLeastDisparity * options_.disparity_sigma;
  result.depth = DepthImage(camera.width, camera.height, 0.0F);
  std::size_t counted = 0, valid = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (result.mask(u, v) != 0) ++counted;
      const float found = disparity(u, v);
      if (found == kNoDisparity || pair.left_mask(u, v) == 0) continue;
      const auto match = static_cast<int>(std::lround(u - static_cast<double>(found)));
      const double parallax = static_cast<double>(found) - rig().offset;
      if (match < 0 || match >= camera.width || pair.right_mask(match, v) == 0) continue;
      if (parallax < least) continue;
      result.depth(u, v) = static_cast<float>(rig().FocalTimesBaseline() / parallax);
      ++valid;
    }
  }
  result.left = std::move(pair.left);
  result.valid_share =
      counted > 0 ? static_cast<double>(valid) / static_cast<double>(counted) : 0.0;
  return result;
}

}  // namespace ceres_ed
