// The flags of ed_fit.
#ifndef CERES_ED_APPS_FIT_FLAGS_H_
#define CERES_ED_APPS_FIT_FLAGS_H_

#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// The settings on the command line: those of the run, and those of what the program shows.
struct FitCommand : FitSettings {
  bool quiet = false;
};

// Returns the settings in the flags after checking them. The error names the flag, its value and
// what was expected.
StatusOr<FitCommand> ReadFitFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_FLAGS_H_
