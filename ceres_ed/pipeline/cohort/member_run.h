// Runs one member of a cohort: hashes its inputs, and fits or tracks it unless that has been done.
#ifndef CERES_ED_PIPELINE_COHORT_MEMBER_RUN_H_
#define CERES_ED_PIPELINE_COHORT_MEMBER_RUN_H_

#include <ceres_ed/pipeline/cohort/cohort_settings.h>
#include <ceres_ed/pipeline/cohort/manifest.h>
#include <ceres_ed/pipeline/cohort/member_record.h>
#include <ceres_ed/pipeline/fit/fit_run.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <functional>
#include <string>

namespace ceres_ed {

// What all members share. Nothing of it changes during the run.
struct CohortContext {
  const CohortSettings* settings = nullptr;
  CohortKind kind = CohortKind::kShapes;
  const EnergyRegistry* registry = nullptr;
  // Null for pairs and sequences.
  const FitSource* source = nullptr;
  const SurfaceFitter* fitter = nullptr;
  // The ContentKey of all that members share.
  std::string shared_key;
};

// How the run of a member ended.
struct MemberRun {
  enum class End {
    // It has a record now: it is done, or has failed.
    kRun,
    // It had been run before, with the same inputs and flags.
    kSkipped,
    // It was stopped, and has left nothing.
    kStopped,
    // Its results cannot be written.
    kNotWritten,
  };
  End end = End::kStopped;
  MemberRecord record;
  // The reason if it is kNotWritten.
  std::string error;
};

// Returns the ContentKey of what all members depend on: version, flags, template.
std::string SharedKey(const CohortSettings& settings, CohortKind kind);

// Runs a member. Its results are in MemberPath() when the function returns:
//   record.json, report.json; of a fit fitted.ply and points.npy (V x 3: the points of the source
//   in the unit of the template), and as requested warp.json, report.html and thumbnail.png; of a
//   sequence what RunSlam() writes.
// May be called from several threads at once.
MemberRun RunMember(const CohortContext& context,
                    const CohortMember& member,
                    const std::function<bool()>& should_stop);

// Returns an estimate of the memory that the run of a member takes, in bytes: from the number of
// points of the template and the size of the member's files (scripts/bench_cohort.py).
std::size_t EstimateMemory(const CohortContext& context, const CohortMember& member);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_MEMBER_RUN_H_
