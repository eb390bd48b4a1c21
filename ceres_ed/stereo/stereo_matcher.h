// Finds depth in the pictures of a stereo camera.
#ifndef CERES_ED_STEREO_STEREO_MATCHER_H_
#define CERES_ED_STEREO_STEREO_MATCHER_H_

#include <ceres_ed/geometry/depth_noise.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/rigid_transform.h>
#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/stereo/disparity.h>
#include <ceres_ed/stereo/rectification.h>
#include <ceres_ed/stereo/stereo_options.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <utility>

namespace ceres_ed {

// The depth that one pair of pictures shows.
struct StereoDepth {
  // In metres, in the rectified left camera; 0 where it is not known.
  DepthImage depth;
  // The rectified left picture, and the pixels of it that count: those with a mask that is not zero
  // and that the picture shows.
  ColorImage left;
  MaskImage mask;
  // The share of the pixels that count whose depth is known; 0 if none counts.
  double valid_share = 0.0;
  // The disparities that were searched, in pixels.
  DisparityRange range;
};

// Turns pairs of pictures into depth. The same pair gives the same bytes at any number of threads
// and in any order of pairs.
class StereoMatcher {
 public:
  // Errors are those of Rectification::Create() and those of options that are not valid.
  // `is_rectified` says that the pictures are rectified.
  static StatusOr<std::unique_ptr<StereoMatcher>> Create(const StereoRig& rig,
                                                         bool is_rectified,
                                                         const StereoOptions& options);

  // The camera of the depth.
  const PinholeCamera& camera() const { return rectification_->rig().camera; }
  const RectifiedRig& rig() const { return rectification_->rig(); }
  // The noise of the depth, from StereoOptions::disparity_sigma.
  DepthNoise noise() const;

  // Returns the pictures of a pair with corresponding rows; see Rectification::Apply().
  RectifiedPair Rectify(const ColorImage& left,
                        const ColorImage& right,
                        const MaskImage& mask) const {
    return rectification_->Apply(left, right, mask);
  }
  // Returns the depth of a pair. All pictures have the size of the rig's cameras; `mask`, of the
  // left picture, may be empty.
  StereoDepth Match(const ColorImage& left, const ColorImage& right, const MaskImage& mask) const;

 private:
  StereoMatcher(std::unique_ptr<const Rectification> rectification, const StereoOptions& options)
      : rectification_(std::move(rectification)), options_(options) {}

  DisparityRange RangeOf(const GrayImage& left,
                         const GrayImage& right,
                         const MaskImage& left_mask) const;
  // Refines disparities, and leaves out those whose windows differ.
  void Polish(const GrayImage& left, const GrayImage& right, DisparityImage* disparity) const;
  // Returns the disparities of a rectified pair, found in pictures `scale` (1, 2 or 4) times
  // smaller.
  DisparityImage Compare(const GrayImage& left,
                         const GrayImage& right,
                         const DisparityRange& range,
                         int scale) const;
  // Returns how many times smaller pictures are compared.
  int Scale() const;

  std::unique_ptr<const Rectification> rectification_;
  StereoOptions options_;
};

// Returns the brightness of a colour picture, 0 to 255: 0.299 R + 0.587 G + 0.114 B, rounded.
GrayImage GrayOf(const ColorImage& color);

}  // namespace ceres_ed

#endif  // CERES_ED_STEREO_STEREO_MATCHER_H_
