// The unit of the source relative to that of the target, as a user gives it.
#ifndef CERES_ED_PIPELINE_FIT_SCALE_SETTING_H_
#define CERES_ED_PIPELINE_FIT_SCALE_SETTING_H_

#include <ceres_ed/registration/fit_options.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// What --scale says.
struct ScaleSetting {
  // Whether the factor follows from the sizes of the clouds.
  bool is_automatic = false;
  // By what the source is multiplied.
  double factor = 1.0;
};

// Returns the setting in `text`: empty for 1, "auto", a number > 0, or two units such as "mm:m":
// those of the source and of the target, of um, mm, cm, in and m. The error says what was expected.
StatusOr<ScaleSetting> ParseScale(const std::string& text);

// Sets the scale in `options` and returns a sentence on it; an empty one if the factor is 1. The
// diagonals are those of the clouds. An automatic factor is 1 if the diagonals differ by at most
// kPlausibleSizeRatio, and a ratio of common units if they differ by nearly that; otherwise it is
// the ratio of the diagonals, and the rigid stage estimates the scale from there.
std::string ApplyScale(const ScaleSetting& setting,
                       double source_diagonal,
                       double target_diagonal,
                       FitOptions* options);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_FIT_SCALE_SETTING_H_
