#include "ceres_ed/stereo/stereo_options.h"

#include <ceres_ed/util/options.h>

namespace ceres_ed {

const OptionTable<StereoOptions>& StereoOptions::Rows() {
  using O = StereoOptions;
  constexpr int kMaxDisparity = 2048;
  static const OptionTable<O> rows({
      Row(&O::mode, "mode", "The number of directions from which costs are summed.").Main(),
      Row(&O::min_disparity, "min_disparity", "The disparity of the farthest tissue.")
          .In(Between(0, kMaxDisparity))
          .Special(0, "automatic")
          .Unit("pixels"),
      Row(&O::max_disparity, "max_disparity", "The disparity of the nearest tissue.")
          .In(Between(0, kMaxDisparity))
          .Special(0, "automatic")
          .Unit("pixels")
          .Main(),
      Row(&O::window, "window", "The width of the windows that are compared; odd.")
          .In(Between(1, 15))
          .Unit("pixels"),
      Row(&O::uniqueness, "uniqueness", "The best match must be better than others by this.")
          .In(Between(0, 100))
          .Unit("percent"),
      Row(&O::left_right,
          "left_right",
          "Leave out a pixel if the match of its match is farther from it than this.")
          .In(AtLeast(-1))
          .Special(-1, "no check")
          .Unit("pixels"),
      Row(&O::correlation,
          "correlation",
          "Leave out a pixel if the windows around it and its match are less alike.")
          .In(Between(-1, 1))
          .Special(-1, "no check"),
      Row(&O::edge_margin, "edge_margin", "Leave out pixels this near to a jump of the depth.")
          .In(Between(0, 20))
          .Unit("pixels"),
      Row(&O::speckle_size, "speckle_size", "Leave out connected parts that are smaller.")
          .In(AtLeast(0))
          .Unit("pixels"),
      Row(&O::highlight, "highlight", "Leave out pixels that are as bright as this (256: none).")
          .In(Between(1, 256)),
      Row(&O::reduce, "reduce", "Compare pictures that are 1, 2 or 4 times smaller.")
          .In(Between(0, 4))
          .Special(0, "automatic: at most 800 columns")
          .Main(),
      Row(&O::refine, "refine", "Refine disparities to fractions of a pixel."),
      Row(&O::smoothing, "smoothing", "Radius of a filter that smooths depth but not its edges.")
          .In(Between(0, 20))
          .Special(0, "none")
          .Unit("pixels"),
      Row(&O::disparity_sigma, "disparity_sigma", "The standard deviation of the disparity.")
          .In(Above(0))
          .Unit("pixels")
          .Main(),
      Row(&O::check,
          "check",
          "Refuse pictures that are swapped or whose rows do not correspond; otherwise only warn."),
  });
  return rows;
}

bool StereoOptions::IsValid(std::string* error) const {
  if (!Rows().Check(*this, error)) return false;
  if (window % 2 == 0) {
    *error = "window is " + std::to_string(window) + ", expected an odd number of pixels";
    return false;
  }
  if (reduce == 3) {
    *error = "reduce is 3, expected 0, 1, 2 or 4";
    return false;
  }
  if (max_disparity != 0 && max_disparity <= min_disparity) {
    *error = "max_disparity is " + std::to_string(max_disparity) +
             ", expected more than min_disparity, which is " + std::to_string(min_disparity);
    return false;
  }
  return true;
}

}  // namespace ceres_ed
