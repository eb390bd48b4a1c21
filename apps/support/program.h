// The parts that all programs share: flags, --help, --version, exit codes and Ctrl-C.
#ifndef CERES_ED_APPS_SUPPORT_PROGRAM_H_
#define CERES_ED_APPS_SUPPORT_PROGRAM_H_

#include <ceres_ed/pipeline/outcome.h>

#include <functional>
#include <string>
#include <vector>

namespace ceres_ed {

// The text that --help shows in addition to the flags.
struct ProgramInfo {
  // The name, for example "ed_fit".
  std::string name;
  // The text after the name on the usage line, for example "SOURCE [TARGET] --output=OUT.ply".
  std::string arguments;
  // The description in one paragraph.
  std::string description;
  // A command line that works.
  std::string example;
  // The smallest and the largest number of positional arguments.
  int min_arguments = 0;
  int max_arguments = 0;
};

// Parses the command line, runs `body` with the positional arguments, and returns the exit code for
// main(). The flags are those of option_flags.h and --flagfile of gflags; the flags of glog work,
// too, but --help does not show them. --help and --version print to stdout and end with 0. If the
// command line is bad, if the outcome is not done, or if an exception leaves `body`, one line is
// printed to stderr: "ed_fit: <sentence>".
int RunProgram(const ProgramInfo& info,
               int argc,
               char** argv,
               const std::function<Outcome(const std::vector<std::string>& arguments)>& body);

// Makes the first SIGINT or SIGTERM request that the program stop, and the second one kill it.
// Before this call the signals have their usual effect.
void InstallStopHandler();

// Returns whether a signal has requested that the program stop.
bool StopRequested();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_PROGRAM_H_
