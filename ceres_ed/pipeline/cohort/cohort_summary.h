// summary.csv and summary.html of a cohort.
#ifndef CERES_ED_PIPELINE_COHORT_COHORT_SUMMARY_H_
#define CERES_ED_PIPELINE_COHORT_COHORT_SUMMARY_H_

#include <ceres_ed/pipeline/cohort/collected_member.h>
#include <ceres_ed/pipeline/cohort/shape_statistics.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes OUTPUT/summary.csv (the worst first) and OUTPUT/summary.html.
Status WriteSummary(const std::string& output,
                    const CollectedMembers& all,
                    const ShapeStatistics& statistics);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_COHORT_SUMMARY_H_
