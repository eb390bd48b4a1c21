// Whether the settings and the members of a cohort fit together.
#ifndef CERES_ED_PIPELINE_COHORT_COHORT_CHECKS_H_
#define CERES_ED_PIPELINE_COHORT_COHORT_CHECKS_H_

#include <ceres_ed/pipeline/cohort/cohort_settings.h>
#include <ceres_ed/pipeline/cohort/manifest.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Checks what does not depend on files: there is one table, a template for shapes alone, and
// --iterate only where all shapes are run. The error names the flags.
Status CheckCohort(const CohortSettings& settings);

// Checks what the members, which are those of the table or folder `table`, and the settings say
// about landmarks and units. The error names the row.
Status CheckMembers(const CohortSettings& settings,
                    const std::string& table,
                    const Manifest& manifest);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_COHORT_CHECKS_H_
