// Parses the command line with gflags. Errors are one sentence, and --help has several formats.
#ifndef CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_
#define CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <apps/support/help/help.h>
#include <apps/support/program.h>
#include <gflags/gflags.h>

namespace ceres_ed {

// What a command line requests. When it is returned, the flags have been set.
struct CommandLine {
  enum class Request { kRun, kHelp, kVersion };

  Request request = Request::kRun;
  // The format of the help that is requested.
  const HelpFormat* help = nullptr;
  std::vector<std::string> arguments;
};

// Sets the flags on the command line and returns the rest. Accepts --name=value, --name value,
// --flag and --noflag, with one dash or two, and the letters of flags that have one; `--` ends the
// flags. A number may be given by its word ("auto"). It is an error if a flag is unknown (the error
// names the nearest flag), if a value is bad, or if the number of positional arguments is wrong.
StatusOr<CommandLine> ParseCommandLine(const ProgramInfo& info, int argc, const char* const* argv);

// Returns the text of --version: a line each for ceres_ed, Ceres, the sparse library, the ordering
// library, BLAS, the vector kernels, and the number of hardware threads.
std::string VersionText();

// Returns the value of the flag `name`, which must exist, as text. A number has the fewest digits
// from which the same number is read; gflags itself would print 0.1 as 0.10000000000000001.
std::string CurrentValue(const std::string& name);

// Returns the program's own flags (option_flags.h), sorted by name.
std::vector<gflags::CommandLineFlagInfo> OwnFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_
