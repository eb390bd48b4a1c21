#include "ceres_ed/pipeline/cohort/member_runs.h"

#include <ceres_ed/pipeline/cohort/job_pool.h>
#include <ceres_ed/pipeline/cohort/member_folder.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>

namespace ceres_ed {
namespace {

// Returns "3 min", "40 s" or "2.5 h".
std::string DurationText(double seconds) {
  if (seconds < 100.0) return std::to_string(std::lround(seconds)) + " s";
  if (seconds < 6000.0) return std::to_string(std::lround(seconds / 60.0)) + " min";
  return std::to_string(std::lround(seconds / 360.0) / 10) + "." +
         std::to_string(std::lround(seconds / 360.0) % 10) + " h";
}

// The runs of all members of a shard.
class MemberRuns {
 public:
  MemberRuns(const CohortContext& context, const Timer& clock, CohortObserver* observer)
      : context_(context), clock_(clock), observer_(*observer) {}

  // Returns how it ended.
  Outcome Run(const std::vector<CohortMember>& members);

 private:
  // Takes the results since the last call, and shows the progress. Returns false if the run must
  // end.
  bool Watch(int ended);
  void Take(const MemberRun& run);
  std::string ProgressNote(int ended) const;

  const CohortContext& context_;
  const Timer& clock_;
  CohortObserver& observer_;
  int total_ = 0;
  int done_ = 0;
  int skipped_ = 0;
  int failed_ = 0;
  // The first error of results that could not be written.
  std::string not_written_;
  std::atomic<bool> must_stop_{false};
  std::mutex mutex_;
  // Results that have not been taken.
  std::vector<MemberRun> fresh_;
};

void MemberRuns::Take(const MemberRun& run) {
  switch (run.end) {
    case MemberRun::End::kRun:
      ++done_;
      break;
    case MemberRun::End::kSkipped:
      ++skipped_;
      break;
    case MemberRun::End::kNotWritten:
      if (not_written_.empty()) not_written_ = run.error;
      return;
    case MemberRun::End::kStopped:
      return;
  }
  if (run.record.state != MemberState::kFailed) return;
  ++failed_;
  observer_.OnWarning(run.record.name + ": " + run.record.message);
}

std::string MemberRuns::ProgressNote(int ended) const {
  std::string note = std::to_string(ended) + " of " + std::to_string(total_);
  if (failed_ > 0) note += ", " + std::to_string(failed_) + " failed";
  // What was skipped took no time, and tells nothing about what is left.
  const int run = done_;
  if (run > 0 && ended < total_) {
    note += ", " + DurationText(clock_.Seconds() / run * (total_ - ended)) + " left";
  }
  return note;
}

bool MemberRuns::Watch(int ended) {
  std::vector<MemberRun> fresh;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    fresh.swap(fresh_);
  }
  for (const MemberRun& run : fresh) Take(run);
  observer_.OnProgress(ended, std::max(1, total_), ProgressNote(ended));
  if (observer_.ShouldStop() || !not_written_.empty()) must_stop_ = true;
  return !must_stop_;
}

Outcome MemberRuns::Run(const std::vector<CohortMember>& members) {
  const CohortSettings& settings = *context_.settings;
  std::vector<const CohortMember*> mine;
  for (const CohortMember& member : members) {
    if (settings.shard.Contains(member.row)) mine.push_back(&member);
  }
  // A member whose run ended with its process may have been the reason, and comes last.
  const std::set<std::string> abandoned = RemoveAbandonedWork(settings.output);
  std::stable_partition(mine.begin(), mine.end(), [&abandoned](const CohortMember* member) {
    return abandoned.count(member->name) == 0;
  });
  total_ = static_cast<int>(mine.size());
  std::vector<std::size_t> needs;
  needs.reserve(mine.size());
  for (const CohortMember* member : mine) needs.push_back(EstimateMemory(context_, *member));
  JobPoolOptions options;
  options.threads = settings.jobs > 0
                        ? settings.jobs
                        : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.memory = static_cast<std::size_t>(settings.memory_mb) << 20;
  const std::function<bool()> should_stop = [this] { return must_stop_.load(); };
  RunJobs(
      needs,
      options,
      [&](int job) {
        MemberRun run = RunMember(context_, *mine[job], should_stop);
        const std::lock_guard<std::mutex> lock(mutex_);
        fresh_.push_back(std::move(run));
      },
      [this](int ended) { return Watch(ended); });
  if (!not_written_.empty()) return Outcome::BadInput(Status::Error(not_written_));
  if (done_ + skipped_ < total_) {
    return Outcome::StoppedEarly("stopped with " + std::to_string(done_ + skipped_) + " of " +
                                 MemberCount(total_) + " in " + settings.output +
                                 "; the same command goes on from there");
  }
  observer_.OnShard(done_, skipped_, failed_);
  if (failed_ == 0) return Outcome::Done();
  return Outcome::NoResult(Status::Error(settings.output + ": " + std::to_string(failed_) + " of " +
                                         MemberCount(total_) + " failed"));
}

}  // namespace

Outcome RunMembers(const CohortContext& context,
                   const std::vector<CohortMember>& members,
                   const Timer& clock,
                   CohortObserver* observer) {
  return MemberRuns(context, clock, observer).Run(members);
}

}  // namespace ceres_ed
