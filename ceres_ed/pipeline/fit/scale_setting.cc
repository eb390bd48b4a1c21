#include "ceres_ed/pipeline/fit/scale_setting.h"

#include <ceres_ed/geometry/unit_ratio.h>
#include <ceres_ed/util/options.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace ceres_ed {
namespace {

// Returns the length of a unit in metres.
std::optional<double> MetresOf(const std::string& unit) {
  constexpr struct {
    const char* name;
    double metres;
  } kUnits[] = {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}, {"m", 1.0}};
  for (const auto& known : kUnits) {
    if (unit == known.name) return known.metres;
  }
  return std::nullopt;
}

}  // namespace

StatusOr<ScaleSetting> ParseScale(const std::string& text) {
  ScaleSetting setting;
  if (text.empty()) return setting;
  if (text == "auto") {
    setting.is_automatic = true;
    return setting;
  }
  const Status bad = Status::Error("--scale=" + text +
                                   ", expected auto, a number > 0, or the units of source and "
                                   "target (um, mm, cm, in, m) such as mm:m");
  if (const std::size_t colon = text.find(':'); colon != std::string::npos) {
    const std::optional<double> from = MetresOf(text.substr(0, colon));
    const std::optional<double> to = MetresOf(text.substr(colon + 1));
    if (!from.has_value() || !to.has_value()) return bad;
    setting.factor = *from / *to;
    return setting;
  }
  char* end = nullptr;
  setting.factor = std::strtod(text.c_str(), &end);
  if (*end != '\0' || !std::isfinite(setting.factor) || !(setting.factor > 0.0)) return bad;
  return setting;
}

std::string ApplyScale(const ScaleSetting& setting,
                       double source_diagonal,
                       double target_diagonal,
                       FitOptions* options) {
  double factor = setting.factor;
  std::string reason;
  if (setting.is_automatic && source_diagonal > 0.0 && target_diagonal > 0.0) {
    const double ratio = target_diagonal / source_diagonal;
    if (std::max(ratio, 1.0 / ratio) > kPlausibleSizeRatio) {
      const std::optional<double> snapped = NearestUnitRatio(ratio);
      factor = snapped.value_or(ratio);
      if (!snapped.has_value()) options->rigid.with_scale = true;
      reason = " (by the sizes of source and target" +
               std::string(snapped.has_value() ? ")" : "; the rigid stage improves it)");
    }
  }
  options->rigid.initial_scale = factor;
  return factor == 1.0 ? "" : "the source is multiplied by " + NumberText(factor) + reason;
}

}  // namespace ceres_ed
