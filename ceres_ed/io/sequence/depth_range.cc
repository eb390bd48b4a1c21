#include "ceres_ed/io/sequence/depth_sequence.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

// Returns a sentence that ends with `question` if the scene is nearer or farther than scenes are.
std::string RangeWarning(const DepthImage& depth, const std::string& question) {
  constexpr float kNearest = 1e-3F;
  constexpr float kFarthest = 100.0F;
  std::vector<float> measured;
  measured.reserve(depth.pixels().size());
  std::copy_if(
      depth.pixels().begin(), depth.pixels().end(), std::back_inserter(measured), [](float value) {
        return value > 0.0F;
      });
  if (measured.empty()) return "";
  const float median = Median(std::move(measured));
  if (median >= kNearest && median <= kFarthest) return "";
  std::ostringstream sentence;
  sentence << "the scene is " << median << " m away, "
           << (median < kNearest ? "nearer than 1 mm" : "farther than 100 m") << ": " << question;
  return sentence.str();
}

std::string Text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

}  // namespace

std::string DepthRangeWarning(const DepthImage& depth, double depth_units_per_metre) {
  return RangeWarning(
      depth, "is the depth really stored as " + Text(depth_units_per_metre) + " units per metre?");
}

std::string StereoRangeWarning(const DepthImage& depth, double baseline) {
  return RangeWarning(depth, "are the cameras really " + Text(baseline) + " m apart?");
}

}  // namespace ceres_ed
