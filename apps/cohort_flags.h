// The flags of ed_cohort.
#ifndef CERES_ED_APPS_COHORT_FLAGS_H_
#define CERES_ED_APPS_COHORT_FLAGS_H_

#include <ceres_ed/pipeline/cohort/cohort_settings.h>
#include <ceres_ed/util/status.h>

namespace ceres_ed {

// The settings on the command line: those of the run, and those of what the program shows.
struct CohortCommand : CohortSettings {
  // Whether finished folders are joined, and nothing is run.
  bool collect = false;
  bool quiet = false;
};

// Returns the settings in the flags after checking them. The error names the flag, its value and
// what was expected.
StatusOr<CohortCommand> ReadCohortFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_COHORT_FLAGS_H_
