#include "ceres_ed/report/view/number_text.h"

#include <cmath>
#include <cstdio>

namespace ceres_ed {

std::string ShortNumber(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  constexpr double kSmallest = 1e-4;
  constexpr double kLargest = 1e6;
  constexpr int kSize = 64;
  char text[kSize];
  const double size = std::abs(value);
  if (size < kSmallest || size >= kLargest) {
    std::snprintf(text, sizeof(text), "%.*e", digits - 1, value);
    return text;
  }
  const int whole = static_cast<int>(std::floor(std::log10(size))) + 1;
  std::snprintf(text, sizeof(text), "%.*f", whole < digits ? digits - whole : 0, value);
  return text;
}

std::string TickText(double value) {
  constexpr int kSize = 64;
  char text[kSize];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

std::vector<double> RoundTicks(double low, double high, int count) {
  if (!(high > low) || !std::isfinite(high - low)) return {low};
  const double rough = (high - low) / (count > 1 ? count : 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough) step = factor * power;
  }
  std::vector<double> ticks;
  constexpr double kSlack = 1e-9;
  const double first = std::ceil(low / step - kSlack);
  for (double i = first; i * step <= high + kSlack * step; i += 1.0) {
    ticks.push_back(i == 0.0 ? 0.0 : i * step);
    if (i + 1.0 == i) break;
  }
  if (ticks.empty()) ticks.push_back(low);
  return ticks;
}

}  // namespace ceres_ed
