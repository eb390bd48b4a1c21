#include "ceres_ed/report/view/scalar_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ceres_ed {

std::string AsideNote(const ScalarField& field) {
  if (std::count(field.aside.begin(), field.aside.end(), 1) == 0) return "";
  return field.hides_aside ? "; grey: what the target does not show"
                           : "; the colours end where those of what the target shows do";
}

FieldRange RangeOfFields(const std::vector<const ScalarField*>& fields) {
  constexpr double kShare = 0.98;
  std::vector<double> sizes;
  std::vector<double> sizes_aside;
  FieldRange range;
  bool is_signed = false;
  for (const ScalarField* const field : fields) {
    is_signed = is_signed || field->scale == ColorScale::kSigned;
    for (std::size_t i = 0; i < field->values.size(); ++i) {
      const double value = field->values[i];
      if (!std::isfinite(value)) continue;
      if (sizes.empty() && sizes_aside.empty()) range.min = range.max = value;
      range.min = std::min(range.min, value);
      range.max = std::max(range.max, value);
      const bool is_aside = !field->aside.empty() && field->aside[i] != 0;
      (is_aside ? sizes_aside : sizes).push_back(std::abs(value));
    }
  }
  if (sizes.empty()) sizes = std::move(sizes_aside);
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
