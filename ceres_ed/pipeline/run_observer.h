// What a run tells its caller while it works, and what it asks.
#ifndef CERES_ED_PIPELINE_RUN_OBSERVER_H_
#define CERES_ED_PIPELINE_RUN_OBSERVER_H_

#include <string>

namespace ceres_ed {

// Every function may be left as it is: then nothing is shown and nothing stops the run. All calls
// come from the thread that runs.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  // A sentence on the input or on what is done with it.
  virtual void OnNote(const std::string& /*sentence*/) {}

  // A sentence on something that may spoil the result. Reports contain it, too.
  virtual void OnWarning(const std::string& /*sentence*/) {}

  // `done` of `total` > 0 steps are finished; `note` says in a few words how it goes.
  virtual void OnProgress(int /*done*/, int /*total*/, const std::string& /*note*/) {}

  // Whether the run should end early and keep what it has so far. Asked often.
  virtual bool ShouldStop() { return false; }
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_RUN_OBSERVER_H_
