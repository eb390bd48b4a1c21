// The interface through which a run reports to its caller, and through which it can be stopped.
#ifndef CERES_ED_PIPELINE_RUN_OBSERVER_H_
#define CERES_ED_PIPELINE_RUN_OBSERVER_H_

#include <string>

namespace ceres_ed {

// By default nothing is shown, and nothing stops the run. All calls come from the thread of the
// run.
class RunObserver {
 public:
  virtual ~RunObserver() = default;

  // Receives a sentence about the input or about what is done with it.
  virtual void OnNote(const std::string& /*sentence*/) {}

  // Receives a sentence about something that may spoil the result. Reports contain it, too.
  virtual void OnWarning(const std::string& /*sentence*/) {}

  // Receives the progress: `done` of `total` > 0 steps are finished. `note` describes the progress
  // in a few words.
  virtual void OnProgress(int /*done*/, int /*total*/, const std::string& /*note*/) {}

  // Returns whether the run should end early and keep its result so far. Called often.
  virtual bool ShouldStop() { return false; }
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_RUN_OBSERVER_H_
