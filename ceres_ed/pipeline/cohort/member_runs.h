// Runs the members of a cohort, several at a time.
#ifndef CERES_ED_PIPELINE_COHORT_MEMBER_RUNS_H_
#define CERES_ED_PIPELINE_COHORT_MEMBER_RUNS_H_

#include <ceres_ed/pipeline/cohort/cohort_observer.h>
#include <ceres_ed/pipeline/cohort/manifest.h>
#include <ceres_ed/pipeline/cohort/member_run.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/util/timer.h>

#include <vector>

namespace ceres_ed {

// Runs those of `members` that belong to the shard of the settings, several at a time within their
// bound of memory. `clock` has the time since the start, for the estimate of what is left. The run
// ends without a result if a member has failed, and as stopped if the observer asks for it; results
// that are finished stay.
Outcome RunMembers(const CohortContext& context,
                   const std::vector<CohortMember>& members,
                   const Timer& clock,
                   CohortObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_MEMBER_RUNS_H_
