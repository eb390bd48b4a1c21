// The text that ed_cohort prints.
#ifndef CERES_ED_APPS_COHORT_TEXT_H_
#define CERES_ED_APPS_COHORT_TEXT_H_

#include <ceres_ed/pipeline/cohort/cohort_run.h>

#include <string>

namespace ceres_ed {

// Returns what has been run, in one line.
std::string ShardSummary(int run, int skipped, int failed);

// Returns a summary of all members in a few aligned lines.
std::string CohortSummary(const CollectedMembers& all, const ShapeStatistics& statistics);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_COHORT_TEXT_H_
