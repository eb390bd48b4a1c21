// Texts about one flag, which all formats of --help share.
#ifndef CERES_ED_APPS_SUPPORT_HELP_FLAG_TEXT_H_
#define CERES_ED_APPS_SUPPORT_HELP_FLAG_TEXT_H_

#include <ceres_ed/util/options.h>

#include <string>
#include <vector>

#include <apps/support/option_flags.h>
#include <gflags/gflags.h>

namespace ceres_ed {

// A part of the help, with the flags of one group.
struct HelpGroup {
  OptionGroup group;
  const char* title;
};
constexpr HelpGroup kHelpGroups[] = {{OptionGroup::kFiles, "Files"},
                                     {OptionGroup::kMain, "What matters"},
                                     {OptionGroup::kExpert, "For experts"}};

// Returns the program's flags of a group, in the order of registration.
std::vector<const OptionFlag*> FlagsOf(OptionGroup group);

// Returns what gflags knows of a flag.
gflags::CommandLineFlagInfo InfoOf(const OptionFlag& flag);

// Returns "true|false", "text", "number" or "integer".
std::string TypeText(const gflags::CommandLineFlagInfo& flag);

// Returns a value of a flag as text. A number has the fewest digits from which the same number is
// read; gflags itself would print 0.1 as 0.10000000000000001.
std::string ValueText(const gflags::CommandLineFlagInfo& flag, const std::string& value);

// Returns the default as text; empty if it is an empty text.
std::string DefaultText(const OptionFlag& flag);

// Returns the sentence of a flag, `names` (the names that its value may have, or some of them), its
// special values, the default and the unit.
std::string DescriptionText(const OptionFlag& flag, const std::string& names);

}  // namespace ceres_ed

#endif  // CERES_ED_APPS_SUPPORT_HELP_FLAG_TEXT_H_
