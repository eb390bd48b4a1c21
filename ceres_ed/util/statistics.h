// Medians, and the deviations that they estimate.
#ifndef CERES_ED_UTIL_STATISTICS_H_
#define CERES_ED_UTIL_STATISTICS_H_

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace ceres_ed {

// The standard deviation of a Gaussian variable of mean 0 is this times the median of its absolute
// value.
inline constexpr double kDeviationPerMedian = 1.4826;

// Returns the median, or T() if there are no values. The median of an even number of values is the
// upper one of the two in the middle.
template <typename T>
T Median(std::vector<T> values) {
  if (values.empty()) return T();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Returns the median as statistics of reports have it, or 0 if there are no values: of an even
// number of values the mean of the two in the middle.
inline double InterpolatedMedian(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

// Returns the value below which the share `rank` (0 to 1) of the values lies, between the two
// nearest of them in proportion; 0 if there are no values.
inline double Percentile(std::vector<double> values, double rank) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double place = rank * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

// Returns an estimate of the standard deviation of values that scatter around 0, which outliers
// hardly change: 1.4826 times the median of the absolute values; 0 if there are no values.
inline double RobustDeviation(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return kDeviationPerMedian * Median(std::move(values));
}

}  // namespace ceres_ed

#endif  // CERES_ED_UTIL_STATISTICS_H_
