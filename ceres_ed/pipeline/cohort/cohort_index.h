// cohort.json: what a folder of a cohort has, or will have.
#ifndef CERES_ED_PIPELINE_COHORT_COHORT_INDEX_H_
#define CERES_ED_PIPELINE_COHORT_COHORT_INDEX_H_

#include <ceres_ed/pipeline/cohort/manifest.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace ceres_ed {

struct CohortIndex {
  CohortKind kind = CohortKind::kShapes;
  // The template, as it was named.
  std::string source;
  // The ContentKey of all that members share.
  std::string shared_key;
  // All members of the manifest, not only those of a shard.
  std::vector<CohortMember> members;
  // The change of the template by round, if it was iterated: {"round", "change", "shapes"}.
  nlohmann::ordered_json rounds = nlohmann::ordered_json::array();
};

// Writes OUTPUT/cohort.json. Processes of the same cohort write the same.
Status WriteCohortIndex(const std::string& output, const CohortIndex& index);

// Reads FOLDER/cohort.json. The error names the file: it can't be read, or is not what ed_cohort
// has written.
StatusOr<CohortIndex> ReadCohortIndex(const std::string& folder);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_COHORT_INDEX_H_
