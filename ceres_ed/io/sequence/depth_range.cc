#include "ceres_ed/io/sequence/depth_sequence.h"

#include <ceres_ed/util/statistics.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

namespace ceres_ed {

std::string DepthRangeWarning(const DepthImage& depth, double depth_units_per_metre) {
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
           << (median < kNearest ? "nearer than 1 mm" : "farther than 100 m")
           << ": is the depth really stored as " << depth_units_per_metre << " units per metre?";
  return sentence.str();
}

}  // namespace ceres_ed
