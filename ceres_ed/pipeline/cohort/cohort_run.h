// Runs a cohort: every member once, and then the summary and the statistics of all.
#ifndef CERES_ED_PIPELINE_COHORT_COHORT_RUN_H_
#define CERES_ED_PIPELINE_COHORT_COHORT_RUN_H_

#include <ceres_ed/pipeline/cohort/cohort_observer.h>
#include <ceres_ed/pipeline/cohort/cohort_settings.h>
#include <ceres_ed/pipeline/outcome.h>
#include <ceres_ed/util/timer.h>

namespace ceres_ed {

// Runs the members of the shard that have not been run, with these inputs and flags, before. If the
// shard is the whole, the results are collected, too. How a run ends:
//   usage      settings contradict one another;
//   bad input  template or manifest can't be read, or results can't be written;
//   no result  at least one member has failed, or has a verdict that `fit.fail_if` names;
//              everything else has been done;
//   stopped    by the observer: what is done is kept, and the same run goes on from there.
Outcome RunCohort(const CohortSettings& settings, const Timer& clock, CohortObserver* observer);

// Joins the members of several folders, or of several shards in one folder. Members that have not
// been run are counted as missing, and the run ends as without a result.
Outcome CollectCohort(const CollectSettings& settings, CohortObserver* observer);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_COHORT_RUN_H_
