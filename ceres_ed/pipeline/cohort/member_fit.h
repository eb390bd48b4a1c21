// Fits one shape or pair of a cohort into its folder.
#ifndef CERES_ED_PIPELINE_COHORT_MEMBER_FIT_H_
#define CERES_ED_PIPELINE_COHORT_MEMBER_FIT_H_

#include <ceres_ed/pipeline/cohort/member_folder.h>
#include <ceres_ed/pipeline/cohort/member_run.h>
#include <ceres_ed/pipeline/outcome.h>

#include <functional>

namespace ceres_ed {

// Fits the template, or the source of a pair, to a member. Sets the figures of `record`. Returns
// how the fit ended.
Outcome FitMember(const CohortContext& context,
                  const CohortMember& member,
                  const MemberFolder& folder,
                  const std::function<bool()>& should_stop,
                  MemberRecord* record);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_MEMBER_FIT_H_
