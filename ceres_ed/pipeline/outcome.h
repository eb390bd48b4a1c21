// How a run ends.
#ifndef CERES_ED_PIPELINE_OUTCOME_H_
#define CERES_ED_PIPELINE_OUTCOME_H_

#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Exit codes of the programs; scripts rely on them.
enum class ExitCode : int {
  kDone = 0,
  kUsage = 1,
  // An input that can't be read or used, or an output that can't be written.
  kBadInput = 2,
  // The solve gave nothing usable.
  kNoResult = 3,
  // Stopped by a time limit or Ctrl-C; the best result so far is written.
  kStoppedEarly = 4,
};

// The code, and for any other than kDone the sentence that says why.
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
