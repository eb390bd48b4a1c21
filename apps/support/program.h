// What every program shares: flags, --help, --version, exit codes, Ctrl-C.
#ifndef CERES_ED_APPS_SUPPORT_PROGRAM_H_
#define CERES_ED_APPS_SUPPORT_PROGRAM_H_

#include <ceres_ed/util/status.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace ceres_ed {

// Exit codes; scripts rely on them.
enum class ExitCode : int {
  kDone = 0,
  kUsage = 1,
  // An input that can't be read or used.
  kBadInput = 2,
  // The solve gave nothing usable.
  kNoResult = 3,
  // Stopped by a time limit or Ctrl-C; the best result so far is written.
  kStoppedEarly = 4,
};

// How a program ended: the code, and for any other than kDone the sentence for stderr.
struct Outcome {
  ExitCode code = ExitCode::kDone;
  std::string message;

  static Outcome Done() { return {}; }
  static Outcome Usage(const std::string& message) { return {ExitCode::kUsage, message}; }
  static Outcome BadInput(const Status& status) { return {ExitCode::kBadInput, status.message()}; }
  static Outcome NoResult(const Status& status) { return {ExitCode::kNoResult, status.message()}; }
  static Outcome StoppedEarly(const std::string& message) {
    return {ExitCode::kStoppedEarly, message};
  }
};

// What --help says of a program beside its flags.
struct ProgramInfo {
  // "ed_fit"
  std::string name;
  // What follows the name on the usage line: "SOURCE [TARGET] --output=OUT.ply".
  std::string arguments;
  // One paragraph.
  std::string description;
  // One command line that works.
  std::string example;
  // How many positional arguments there may be.
  int min_arguments = 0;
  int max_arguments = 0;
};

// Parses the command line, runs `body` with the positional arguments, and returns the exit code for
// main(). Flags are the DEFINE_s of the files under apps/ (of gflags' own only --flagfile, of
// glog's all, but hidden). --help and --version print to stdout and end with 0. A bad command line,
// an outcome other than done, and an exception that escapes `body` print one line on stderr:
// "ed_fit: <sentence>".
int RunProgram(const ProgramInfo& info,
               int argc,
               char** argv,
               const std::function<Outcome(const std::vector<std::string>& arguments)>& body);

// Returns the flag that the first SIGINT or SIGTERM sets; the second one kills. The signals do what
// they always did until this is called for the first time.
const std::atomic<bool>& StopRequested();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_PROGRAM_H_
