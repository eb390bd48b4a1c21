#include "apps/support/help/help.h"

#include <algorithm>
#include <sstream>
#include <vector>

#include <apps/support/help/flag_text.h>

namespace ceres_ed {
namespace {

constexpr int kHelpColumns = 100;

// The flags that are shown.
enum class Scope {
  // The flags for files and the flags for most users.
  kShort,
  kAll,
};

// Breaks `text` into lines of at most `width` columns and indents all but the first by `indent`.
std::string Wrap(const std::string& text, int indent, int width) {
  std::istringstream words(text);
  std::string result;
  std::string word;
  int column = 0;
  while (words >> word) {
    const int size = static_cast<int>(word.size());
    if (column > 0 && column + 1 + size > width) {
      result += "\n" + std::string(indent, ' ');
      column = 0;
    } else if (column > 0) {
      result += " ";
      ++column;
    }
    result += word;
    column += size;
  }
  return result;
}

// Returns the first of a list of names if the list is long, and "...".
std::string FirstNames(const std::string& names) {
  constexpr int kMost = 5;
  constexpr int kShown = 3;
  if (std::count(names.begin(), names.end(), ',') < kMost) return names;
  std::size_t end = 0;
  for (int i = 0; i < kShown; ++i) end = names.find(',', end) + 1;
  return names.substr(0, end) + " ..";
}

// Returns a text such as "output, -o".
std::string NamesOf(const Option& option) {
  return option.letter == 0 ? option.name : option.name + ", -" + option.letter;
}

std::string HelpLines(const std::vector<const OptionFlag*>& flags,
                      std::size_t name_width,
                      Scope scope) {
  constexpr int kTypeWidth = 10;
  const int indent = static_cast<int>(name_width) + kTypeWidth + 6;
  std::string text;
  for (const OptionFlag* flag : flags) {
    const std::string names = NamesOf(*flag->option);
    const std::string type = TypeText(InfoOf(*flag));
    text +=
        "  --" + names + std::string(name_width - names.size() + 1, ' ') + type +
        std::string(kTypeWidth - type.size() + 1, ' ') +
        Wrap(DescriptionText(*flag, scope == Scope::kShort ? FirstNames(flag->names) : flag->names),
             indent,
             kHelpColumns - indent) +
        "\n";
  }
  return text;
}

std::string HelpText(const ProgramInfo& info, Scope scope) {
  std::string text = "Usage: " + info.name + " " + info.arguments + "\n\n" +
                     Wrap(info.description, 0, kHelpColumns) + "\n";
  std::size_t name_width = 0;
  std::size_t num_hidden = 0;
  for (const OptionFlag* flag : RegisteredOptionFlags()) {
    const bool is_hidden = scope == Scope::kShort && flag->option->group == OptionGroup::kExpert;
    if (is_hidden) ++num_hidden;
    if (!is_hidden) name_width = std::max(name_width, NamesOf(*flag->option).size());
  }
  for (const HelpGroup& group : kHelpGroups) {
    const std::vector<const OptionFlag*> flags = FlagsOf(group.group);
    if (flags.empty()) continue;
    if (scope == Scope::kShort && group.group == OptionGroup::kExpert) continue;
    text += "\n" + std::string(group.title) + " [default]:\n" + HelpLines(flags, name_width, scope);
  }
  if (num_hidden > 0) {
    text += "\n--help=all shows " + std::to_string(num_hidden) + " more flags, for experts.\n";
  }
  return text + "\nExample: " + info.example + "\n";
}

constexpr HelpFormat kFormats[] = {{"", ShortHelp},
                                   {"all", FullHelp},
                                   {"markdown", MarkdownHelp},
                                   {"man", ManPage},
                                   {"bash", BashCompletion}};

}  // namespace

const HelpFormat* FindHelpFormat(const std::string& name) {
  for (const HelpFormat& format : kFormats) {
    if (name == format.name) return &format;
  }
  return nullptr;
}

std::string ShortHelp(const ProgramInfo& info) { return HelpText(info, Scope::kShort); }

std::string FullHelp(const ProgramInfo& info) { return HelpText(info, Scope::kAll); }

}  // namespace ceres_ed
