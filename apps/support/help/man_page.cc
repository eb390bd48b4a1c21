#include <ceres_ed/version.h>

#include <algorithm>
#include <cctype>

#include <apps/support/help/flag_text.h>
#include <apps/support/help/help.h>

namespace ceres_ed {
namespace {

// Escapes a text for roff. A line that began with a dot or an apostrophe would be a request, and a
// bare dash would be set as a hyphen, which nobody can copy into a terminal.
std::string Escaped(const std::string& text) {
  std::string escaped;
  bool at_line_start = true;
  for (const char letter : text) {
    if (at_line_start && (letter == '.' || letter == '\'')) escaped += "\\&";
    if (letter == '\\') {
      escaped += "\\e";
    } else if (letter == '-') {
      escaped += "\\-";
    } else {
      escaped += letter;
    }
    at_line_start = letter == '\n';
  }
  return escaped;
}

std::string UpperCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::toupper(letter));
  });
  return text;
}

std::string Section(const std::string& title) { return ".SH " + UpperCase(title) + "\n"; }

std::string Paragraph(const std::string& text) { return Escaped(text) + "\n"; }

// Returns an entry of a list: a term in bold, what follows it in italics, and its description.
std::string Entry(const std::string& bold,
                  const std::string& italic,
                  const std::string& description) {
  std::string term = "\\fB" + Escaped(bold) + "\\fR";
  if (!italic.empty()) term += "\\fI" + Escaped(italic) + "\\fR";
  return ".TP\n" + term + "\n" + Paragraph(description);
}

std::string FlagEntry(const OptionFlag& flag) {
  const Option& option = *flag.option;
  std::string names = "--" + option.name;
  if (option.letter != 0) names = std::string("-") + option.letter + ", " + names;
  return Entry(names, "=" + TypeText(InfoOf(flag)), DescriptionText(flag, flag.names));
}

// Returns the first sentence without its full stop and with a small first letter, as apropos(1)
// wants it.
std::string Summary(const std::string& description) {
  std::string sentence = description.substr(0, description.find(". "));
  if (!sentence.empty() && sentence.back() == '.') sentence.pop_back();
  if (sentence.size() > 1 && std::islower(static_cast<unsigned char>(sentence[1])) != 0) {
    sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
  }
  return sentence;
}

std::string ExitStatus() {
  return Section("Exit status") + Entry("0", "", "Done.") +
         Entry("1", "", "The command line is wrong.") +
         Entry("2", "", "An input cannot be read or used.") +
         Entry("3",
               "",
               "There is no usable result, or its verdict is what --fail_if names; in the second "
               "case the outputs are written.") +
         Entry("4",
               "",
               "Stopped early, by a time limit or a signal; the best result so far is written.") +
         ".PP\n" + Paragraph("A failure prints one line to standard error.");
}

}  // namespace

std::string ManPage(const ProgramInfo& info) {
  std::string page =
      ".TH " + UpperCase(info.name) + " 1 \"\" \"ceres_ed " + kVersion + "\" \"User Commands\"\n" +
      Section("Name") + Paragraph(info.name + " - " + Summary(info.description)) +
      Section("Synopsis") + ".B " + Escaped(info.name) + "\n" + Paragraph(info.arguments) +
      Section("Description") + Paragraph(info.description) + Section("Options") +
      Paragraph(
          "The default and its unit are in brackets. A value follows = or a "
          "blank; --noNAME is --NAME=false.");
  for (const HelpGroup& group : kHelpGroups) {
    const std::vector<const OptionFlag*> flags = FlagsOf(group.group);
    if (flags.empty()) continue;
    page += std::string(".SS ") + group.title + "\n";
    for (const OptionFlag* flag : flags) page += FlagEntry(*flag);
  }
  page += ".SS Every program\n" +
          Entry("-h, --help", "[=all]", "Print the main flags, or all, and exit.") +
          Entry("--version", "", "Print the versions of ceres_ed and of its libraries, and exit.") +
          Entry("--flagfile", "=FILE", "Read more flags from a file, one in each line.");
  return page + ExitStatus() + Section("Example") + ".nf\n" + Paragraph(info.example) + ".fi\n";
}

}  // namespace ceres_ed
