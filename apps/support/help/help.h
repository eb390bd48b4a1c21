// What --help prints, in each of its formats. The text comes from the ProgramInfo and from the rows
// of the options.
#ifndef CERES_ED_APPS_SUPPORT_HELP_HELP_H_
#define CERES_ED_APPS_SUPPORT_HELP_HELP_H_

#include <string>

#include <apps/support/program.h>

namespace ceres_ed {

// A format of --help.
struct HelpFormat {
  // What stands behind `--help=`; empty for --help alone.
  const char* name;
  std::string (*text)(const ProgramInfo& info);
};

// Returns the format with this name, or null.
const HelpFormat* FindHelpFormat(const std::string& name);

// Returns the flags for files and the flags for most users, in lines of at most 100 columns.
std::string ShortHelp(const ProgramInfo& info);

// Returns the same with every flag.
std::string FullHelp(const ProgramInfo& info);

// Returns a table of all flags in Markdown: name, unit, range, default and meaning.
std::string MarkdownHelp(const ProgramInfo& info);

// Returns a manual page of section 1 for man(1), with every flag.
std::string ManPage(const ProgramInfo& info);

// Returns a script with which bash completes flags, the names that their values may have, and
// files.
std::string BashCompletion(const ProgramInfo& info);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_HELP_HELP_H_
