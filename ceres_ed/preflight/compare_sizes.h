// Tells whether two sizes of one thing are given in different units.
#ifndef CERES_ED_PREFLIGHT_COMPARE_SIZES_H_
#define CERES_ED_PREFLIGHT_COMPARE_SIZES_H_

#include <optional>
#include <string>

namespace ceres_ed {

// A cloud and the diagonal of its bounding box.
struct NamedSize {
  std::string name;
  double diagonal = 0.0;
};

// Two sizes that differ as units do.
struct SizeMismatch {
  // A sentence that names both, their ratio, and the ratio of units that is near.
  std::string text;
  // other / one.
  double ratio = 1.0;
  // The ratio of common units that is near, if there is one.
  std::optional<double> unit;
};

// Returns the mismatch if the diagonals differ by more than kPlausibleSizeRatio (unit_ratio.h);
// nothing otherwise, and if one of them is 0.
std::optional<SizeMismatch> CompareSizes(const NamedSize& one, const NamedSize& other);

}  // namespace ceres_ed

#endif  // CERES_ED_PREFLIGHT_COMPARE_SIZES_H_
