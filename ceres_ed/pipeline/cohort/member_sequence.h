// Tracks one sequence of a cohort into its folder.
#ifndef CERES_ED_PIPELINE_COHORT_MEMBER_SEQUENCE_H_
#define CERES_ED_PIPELINE_COHORT_MEMBER_SEQUENCE_H_

#include <ceres_ed/pipeline/cohort/member_folder.h>
#include <ceres_ed/pipeline/cohort/member_run.h>
#include <ceres_ed/pipeline/outcome.h>

#include <functional>

namespace ceres_ed {

// Tracks the sequence of a member. Sets the verdict of `record`. Returns how the run ended.
Outcome TrackMember(const CohortContext& context,
                    const CohortMember& member,
                    const MemberFolder& folder,
                    const std::function<bool()>& should_stop,
                    MemberRecord* record);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_MEMBER_SEQUENCE_H_
