#include "ceres_ed/preflight/compare_sizes.h"

#include <ceres_ed/geometry/unit_ratio.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <sstream>

namespace ceres_ed {

std::optional<SizeMismatch> CompareSizes(const NamedSize& one, const NamedSize& other) {
  if (!(one.diagonal > 0.0) || !(other.diagonal > 0.0)) return std::nullopt;
  SizeMismatch mismatch;
  mismatch.ratio = other.diagonal / one.diagonal;
  const double factor = std::max(mismatch.ratio, 1.0 / mismatch.ratio);
  if (factor <= kPlausibleSizeRatio) return std::nullopt;
  mismatch.unit = NearestUnitRatio(mismatch.ratio);
  std::ostringstream text;
  text.precision(4);
  text << other.name << " is " << factor << " times as "
       << (mismatch.ratio > 1.0 ? "large" : "small") << " as " << one.name << " (diagonals "
       << other.diagonal << " and " << one.diagonal << ')';
  if (mismatch.unit.has_value()) {
    text << ", as if their units differed by a factor of "
         << NumberText(std::max(*mismatch.unit, 1.0 / *mismatch.unit));
  }
  mismatch.text = text.str();
  return mismatch;
}

}  // namespace ceres_ed
