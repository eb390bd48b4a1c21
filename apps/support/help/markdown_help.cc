#include <apps/support/help/flag_text.h>
#include <apps/support/help/help.h>

namespace ceres_ed {
namespace {

std::string RangeCell(const OptionFlag& flag) {
  const std::string type = TypeText(InfoOf(flag));
  if (!flag.names.empty()) return flag.names;
  return type == "text" || type == "true|false" ? type : flag.expected;
}

// Returns the text of a cell. A bar would end the cell, so it is escaped.
std::string AsCell(const std::string& text) {
  std::string cell;
  for (const char letter : text)
    cell += letter == '|' ? std::string("\\|") : std::string(1, letter);
  return cell.empty() ? "-" : cell;
}

}  // namespace

std::string MarkdownHelp(const ProgramInfo&) {
  std::string table = "| flag | unit | range | default | meaning |\n|---|---|---|---|---|\n";
  for (const HelpGroup& group : kHelpGroups) {
    for (const OptionFlag* flag : FlagsOf(group.group)) {
      const Option& option = *flag->option;
      table += "| `--" + option.name + "` | " + AsCell(option.unit) + " | " +
               AsCell(RangeCell(*flag)) + " | " + AsCell(DefaultText(*flag)) + " | " +
               AsCell(option.doc) + " |\n";
    }
  }
  return table;
}

}  // namespace ceres_ed
