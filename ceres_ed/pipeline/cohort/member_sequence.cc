#include "ceres_ed/pipeline/cohort/member_sequence.h"

#include <ceres_ed/pipeline/slam/slam_run.h>
#include <ceres_ed/pipeline/slam/slam_verdict.h>

#include <utility>

namespace ceres_ed {
namespace {

class SequenceObserver : public SlamObserver {
 public:
  SequenceObserver(const std::function<bool()>& should_stop, MemberRecord* record)
      : should_stop_(should_stop), record_(*record) {}

  bool ShouldStop() override { return should_stop_(); }

  void OnEnd(const SlamRun& run) override {
    const Verdict verdict = JudgeRun(*run.records, run.slam->unit());
    record_.grade = verdict.grade;
    if (!verdict.reasons.empty()) record_.message = verdict.reasons.front().text;
  }

 private:
  const std::function<bool()>& should_stop_;
  MemberRecord& record_;
};

}  // namespace

Outcome TrackMember(const CohortContext& context,
                    const CohortMember& member,
                    const MemberFolder& folder,
                    const std::function<bool()>& should_stop,
                    MemberRecord* record) {
  SlamSettings settings = context.settings->slam;
  settings.input = member.path;
  settings.output = folder.File("tracked");
  settings.options.num_threads = 1;
  // The folder appears as a whole; nothing would continue from a checkpoint.
  settings.checkpoint_every = 0;
  SequenceObserver observer(should_stop, record);
  const Timer clock;
  return RunSlam(settings, clock, &observer);
}

}  // namespace ceres_ed
