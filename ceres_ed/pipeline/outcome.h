// How a run ends.
#ifndef CERES_ED_PIPELINE_OUTCOME_H_
#define CERES_ED_PIPELINE_OUTCOME_H_

#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// The exit codes of the programs. Scripts rely on them.
enum class ExitCode : int {
  kDone = 0,
  kUsage = 1,
  // An input cannot be read or used, or an output cannot be written.
  kBadInput = 2,
  // There is no usable result.
  kNoResult = 3,
  // A time limit or Ctrl-C has stopped the run. The best result so far has been written.
  kStoppedEarly = 4,
};

// The exit code and, unless it is kDone, a sentence that gives the reason.
struct Outcome {
  ExitCode code = ExitCode::kDone;
  std::string message;

  bool done() const { return code == ExitCode::kDone; }

  static Outcome Done() { return {}; }
  static Outcome Usage(const std::string& message) { return {ExitCode::kUsage, message}; }
  static Outcome BadInput(const Status& status) { return {ExitCode::kBadInput, status.message()}; }
  static Outcome NoResult(const Status& status) { return {ExitCode::kNoResult, status.message()}; }
  static Outcome StoppedEarly(const std::string& message) {
    return {ExitCode::kStoppedEarly, message};
  }
};

}  // namespace ceres_ed

#endif  // CERES_ED_PIPELINE_OUTCOME_H_
