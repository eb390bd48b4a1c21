// The flags of ed_fit.
#ifndef CERES_ED_APPS_FIT_FLAGS_H_
#define CERES_ED_APPS_FIT_FLAGS_H_

#include <ceres_ed/pipeline/fit/fit_settings.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// What the command line asks for: the run, and what the program shows of it.
struct FitCommand : FitSettings {
  bool quiet = false;
};

// Returns the flags as they are now, checked. Error: names the flag, its value and what was
// expected.
StatusOr<FitCommand> ReadFitFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_FIT_FLAGS_H_
