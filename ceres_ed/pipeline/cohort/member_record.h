// What is known of a member of a cohort after its run: the row of the summary.
#ifndef CERES_ED_PIPELINE_COHORT_MEMBER_RECORD_H_
#define CERES_ED_PIPELINE_COHORT_MEMBER_RECORD_H_

#include <ceres_ed/pipeline/verdict.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

namespace ceres_ed {

// How far a member has come. Failed: its run gave nothing usable. Missing: it has not been run.
enum class MemberState { kDone, kFailed, kMissing };

constexpr std::array<NamedValue<MemberState>, 3> NamesOf(MemberState) {
  return {{{"done", MemberState::kDone},
           {"failed", MemberState::kFailed},
           {"missing", MemberState::kMissing}}};
}

// Figures that are not known are NaN.
struct MemberRecord {
  std::string name;
  // What the run depended on (ContentKey), and the part of it that all members share: template and
  // flags.
  std::string key;
  std::string shared_key;
  MemberState state = MemberState::kMissing;
  Grade grade = Grade::kBad;
  // The shares of the surface of the template, and of the shape, that have no partner.
  double unmatched_source = std::numeric_limits<double>::quiet_NaN();
  double unmatched_target = std::numeric_limits<double>::quiet_NaN();
  // The root mean square error of the landmarks, in the unit of the shape, and their number.
  double landmark_rms = std::numeric_limits<double>::quiet_NaN();
  int landmarks = 0;
  // The 95th percentile of |log(l' / l)| over the edges; see FitEvidence.
  double stretch = std::numeric_limits<double>::quiet_NaN();
  // The time of the run. Nothing else of a record changes when it is made again.
  double seconds = 0.0;
  // Why it failed, or the first reason of a verdict that is not good.
  std::string message;

  // Returns "good", "doubtful", "bad", "failed" or "missing".
  std::string Verdict() const;
};

nlohmann::ordered_json RecordReport(const MemberRecord& record);

// Reads record.json. The error names the file: it can't be read, or is no record.
StatusOr<MemberRecord> ReadRecord(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_COHORT_MEMBER_RECORD_H_
