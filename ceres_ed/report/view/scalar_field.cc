#include "ceres_ed/report/view/scalar_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ceres_ed {

FieldRange RangeOfFields(const std::vector<const ScalarField*>& fields) {
  constexpr double kShare = 0.98;
  std::vector<double> sizes;
  FieldRange range;
  bool is_signed = false;
  for (const ScalarField* const field : fields) {
    is_signed = is_signed || field->scale == ColorScale::kSigned;
    for (const double value : field->values) {
      if (!std::isfinite(value)) continue;
      if (sizes.empty()) range.min = range.max = value;
      range.min = std::min(range.min, value);
      range.max = std::max(range.max, value);
      sizes.push_back(std::abs(value));
    }
  }
  if (sizes.empty()) return range;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(
                                      std::lround(kShare * static_cast<double>(sizes.size() - 1)));
  std::nth_element(sizes.begin(), at, sizes.end());
  range.high = *at;
  // Only a few values differ from 0.
  if (range.high == 0.0) range.high = *std::max_element(sizes.begin(), sizes.end());
  range.low = is_signed ? -range.high : 0.0;
  return range;
}

}  // namespace ceres_ed
