// Options for finding depth in the pictures of a stereo camera.
#ifndef CERES_ED_STEREO_STEREO_OPTIONS_H_
#define CERES_ED_STEREO_STEREO_OPTIONS_H_

#include <ceres_ed/util/named_values.h>

#include <array>
#include <string>

namespace ceres_ed {

// The way in which costs are summed over the picture (OpenCV's modes of semi-global matching).
enum class StereoMode {
  // From five directions.
  kSgbm,
  // From eight directions: slower.
  kHh,
  // From three directions: faster.
  kThreeWay,
  // From four directions: faster.
  kHh4,
};

constexpr std::array<NamedValue<StereoMode>, 4> NamesOf(StereoMode) {
  return {{{"sgbm", StereoMode::kSgbm},
           {"hh", StereoMode::kHh},
           {"3way", StereoMode::kThreeWay},
           {"hh4", StereoMode::kHh4}}};
}

struct StereoOptions {
  StereoMode mode = StereoMode::kThreeWay;
  // The range of disparities relative to infinity, that is of f b / z, in pixels of the rectified
  // pictures; 0 <= min < max. 0: the range is found in a small copy of each pair.
  int min_disparity = 0;
  int max_disparity = 0;
  // The width of the compared windows in pixels, odd, 1 to 15.
  int window = 5;
  // The best match must be better than all others by this share, in percent; 0 to 100.
  int uniqueness = 5;
  // A pixel is left out if the match of its match is more than this many pixels away from it;
  // -1: no check.
  int left_right = 1;
  // A pixel is left out if the correlation of its window in the two pictures is less than this; -1
  // (all are kept) to 1.
  double correlation = 0.5;
  // Pixels this near to a jump of the depth or to a part without depth are left out, in pixels; >=
  // 0 and <= 20.
  int edge_margin = 4;
  // Connected parts with fewer pixels than this are left out; >= 0.
  int speckle_size = 200;
  // Pixels with a channel of this value or more are left out, in both pictures; 1 to 256. 256:
  // none.
  int highlight = 250;
  // Pictures that are this many times smaller are compared: 1, 2 or 4. 0: the least of these with
  // which they have at most 800 columns (4 if none is enough).
  int reduce = 0;
  // Whether disparities are refined to fractions of a pixel by the gradient of the pictures.
  bool refine = true;
  // The radius of a filter that smooths depth but not its edges, in pixels; 0: no filter; <= 20.
  int smoothing = 5;
  // The standard deviation of the disparity in pixels of the pictures, > 0; it is part of the noise
  // of the depth (depth_noise.h).
  double disparity_sigma = 0.25;

  // Whether a sequence is refused if left and right are swapped or the rows do not correspond.
  bool check = true;

  // Returns true if every option is in its range. Otherwise returns false and writes to `error` the
  // value and what was expected.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<StereoOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_STEREO_STEREO_OPTIONS_H_
