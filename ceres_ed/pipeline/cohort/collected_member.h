// The members of one or several folders of a cohort, with what is known of each.
#ifndef CERES_ED_PIPELINE_COHORT_COLLECTED_MEMBER_H_
#define CERES_ED_PIPELINE_COHORT_COLLECTED_MEMBER_H_

#include <ceres_ed/pipeline/cohort/cohort_index.h>
#include <ceres_ed/pipeline/cohort/member_record.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

struct CollectedMember {
  CohortMember member;
  MemberRecord record;
  // The folder with its results; empty if there are none.
  std::string folder;
  // Whether it takes part in the statistics.
  bool in_model = false;
};

struct CollectedMembers {
  // That of the first folder, with the members of all.
  CohortIndex index;
  // In the order of the manifest.
  std::vector<CollectedMember> members;

  int Count(MemberState state) const;
  int Count(Grade grade) const;
};

// Reads the records of all members in these folders. The members of the first folder come first, in
// the order of its manifest, and then those that only the next ones have. A member that several
// folders have is taken from the first of them in which it is done. One that was made from another
// template, or with other flags, than those of the first folder counts as missing, and says so. It
// is an error if a folder has no cohort, or one of another kind.
StatusOr<CollectedMembers> ReadMembers(const std::vector<std::string>& folders);

// Returns the numbers of the members, the worst first: failed, missing, bad, doubtful, good; and of
// equal ones that with the largest unmatched share, landmark error and stretch.
std::vector<int> WorstFirst(const std::vector<CollectedMember>& members);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_COLLECTED_MEMBER_H_
