// What every program shares: flags, --help, --version, exit codes, Ctrl-C.
#ifndef CERES_ED_APPS_SUPPORT_PROGRAM_H_
#define CERES_ED_APPS_SUPPORT_PROGRAM_H_

#include <ceres_ed/pipeline/outcome.h>

#include <functional>
#include <string>
#include <vector>

namespace ceres_ed {

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
// main(). Flags are those of option_flags.h (of gflags' own only --flagfile, of glog's all, but
// hidden). --help and --version print to stdout and end with 0. A bad command line,
// an outcome other than done, and an exception that escapes `body` print one line on stderr:
// "ed_fit: <sentence>".
int RunProgram(const ProgramInfo& info,
               int argc,
               char** argv,
               const std::function<Outcome(const std::vector<std::string>& arguments)>& body);

// Has the first SIGINT or SIGTERM ask the program to stop; the second one kills. Until this is
// called the signals do what they always did.
void InstallStopHandler();

// Returns whether a signal has asked the program to stop.
bool StopRequested();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_PROGRAM_H_
