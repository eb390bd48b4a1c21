// What watches the run of a cohort.
#ifndef CERES_ED_PIPELINE_COHORT_COHORT_OBSERVER_H_
#define CERES_ED_PIPELINE_COHORT_COHORT_OBSERVER_H_

#include <ceres_ed/pipeline/cohort/collected_member.h>
#include <ceres_ed/pipeline/cohort/shape_statistics.h>
#include <ceres_ed/pipeline/run_observer.h>

namespace ceres_ed {

// A RunObserver that also receives the end of a cohort.
class CohortObserver : public RunObserver {
 public:
  // Called when the members of a shard have been run.
  virtual void OnShard(int /*run*/, int /*skipped*/, int /*failed*/) {}
  // Called when the summary and the statistics have been written.
  virtual void OnCollected(const CollectedMembers& /*all*/, const ShapeStatistics& /*statistics*/) {
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_COHORT_OBSERVER_H_
