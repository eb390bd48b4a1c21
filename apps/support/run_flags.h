// The flags of a program as data for the library.
#ifndef CERES_ED_APPS_SUPPORT_RUN_FLAGS_H_
#define CERES_ED_APPS_SUPPORT_RUN_FLAGS_H_

#include <ceres_ed/pipeline/run_flag.h>

namespace ceres_ed {

// Returns the program's own flags with their current values, sorted by name.
RunFlags CurrentFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_RUN_FLAGS_H_
