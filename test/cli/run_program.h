// Runs a program the way a shell does, and keeps everything that it says.
#ifndef CERES_ED_TEST_CLI_RUN_PROGRAM_H_
#define CERES_ED_TEST_CLI_RUN_PROGRAM_H_

#include <functional>
#include <string>
#include <vector>

namespace ceres_ed {

struct ProgramResult {
  // What main returned; -1 when the program was killed or couldn't be started.
  int exit_code = -1;
  // The signal that ended it, or 0.
  int signal = 0;
  // Killed by us at the end of its time.
  bool timed_out = false;
  std::string out;
  std::string err;
};

struct RunOptions {
  double timeout_s = 120.0;
  // Sends this signal...
  int signal = 0;
  // ...this long after the start...
  double signal_after_s = 0.0;
  // ...and not before this holds, where it is given. Asked every few milliseconds.
  std::function<bool()> signal_when;
  // Empty: that of the test.
  std::string working_directory;
};

// Returns the outcome of `program` (a path) with `arguments`, an empty stdin, and stdout and stderr
// that are no terminals.
ProgramResult RunProgramFile(const std::string& program,
                             const std::vector<std::string>& arguments,
                             const RunOptions& options = {});

// Returns whether this machine can make terminals; a chroot without /dev/pts cannot.
bool HasTerminals();

// Returns the outcome of `program` on a terminal of its own; `out` is all that the terminal got.
ProgramResult RunOnTerminal(const std::string& program, const std::vector<std::string>& arguments);

// Path of a program of this build: AppPath("ed_fit").
std::string AppPath(const std::string& name);

// Returns the lines of `text`, without their ends.
std::vector<std::string> SplitLines(const std::string& text);

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_CLI_RUN_PROGRAM_H_
