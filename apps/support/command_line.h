// Parses the command line with gflags. Errors are one sentence, and --help fits on one screen.
#ifndef CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_
#define CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <apps/support/program.h>
#include <gflags/gflags.h>

namespace ceres_ed {

// What a command line requests. When it is returned, the flags have been set.
struct CommandLine {
  enum class Request { kRun, kHelp, kHelpAll, kHelpMarkdown, kVersion };

  Request request = Request::kRun;
  std::vector<std::string> arguments;
};

// Sets the flags on the command line and returns the rest. Accepts --name=value, --name value,
// --flag and --noflag, with one dash or two, and the letters of flags that have one; `--` ends the
// flags. A number may be given by its word ("auto"). It is an error if a flag is unknown (the error
// names the nearest flag), if a value is bad, or if the number of positional arguments is wrong.
StatusOr<CommandLine> ParseCommandLine(const ProgramInfo& info, int argc, const char* const* argv);

// The flags that --help shows.
enum class HelpScope {
  // The flags for files and the flags for most users.
  kShort,
  // Every flag.
  kAll,
};

// Returns the text of --help in lines of at most 100 columns.
std::string HelpText(const ProgramInfo& info, HelpScope scope);

// Returns a table of all flags in Markdown: name, unit, range, default and meaning.
std::string FlagsAsMarkdown();

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
