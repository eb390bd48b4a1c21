// The command line over gflags: one-sentence errors and a --help of one screen.
#ifndef CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_
#define CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <apps/support/program.h>
#include <gflags/gflags.h>

namespace ceres_ed {

// What a command line asks for; flags have been set when it is returned.
struct CommandLine {
  enum class Request { kRun, kHelp, kHelpAll, kHelpMarkdown, kVersion };

  Request request = Request::kRun;
  std::vector<std::string> arguments;
};

// Sets the flags that are named on the command line and returns the rest. Takes --name=value,
// --name value, --flag and --noflag, with one dash or two, and the letters of flags that have one;
// `--` ends the flags. A number may be given by its word ("auto"). Error: unknown flag, with the
// nearest one that there is; bad value; wrong number of positional arguments.
StatusOr<CommandLine> ParseCommandLine(const ProgramInfo& info, int argc, const char* const* argv);

// What --help shows.
enum class HelpScope {
  // Files, and what matters to most users.
  kShort,
  // Every flag.
  kAll,
};

// Returns the text of --help: at most 100 columns.
std::string HelpText(const ProgramInfo& info, HelpScope scope);

// Returns a table of all flags for a page: name, unit, range, default and meaning.
std::string FlagsAsMarkdown();

// Returns the text of --version: ceres_ed, Ceres, sparse library, BLAS and hardware threads, a line
// each.
std::string VersionText();

// Returns a flag's value as text, a number in as few digits as read back as the same: gflags' own
// text of 0.1 is 0.10000000000000001. `name` is that of a flag that is there.
std::string CurrentValue(const std::string& name);

// Returns the program's own flags (option_flags.h) by name.
std::vector<gflags::CommandLineFlagInfo> OwnFlags();

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_COMMAND_LINE_H_
