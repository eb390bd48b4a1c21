#include "ceres_ed/pipeline/run_command.h"

#include <string_view>

namespace ceres_ed {
namespace {

// Returns a word as it is if a shell reads it so, and otherwise in single quotes.
std::string ShellWord(const std::string& word) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./=:,+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string CommandText(const std::string& program,
                        const std::vector<std::string>& arguments,
                        const RunFlags& flags) {
  std::string command = program;
  for (const std::string& argument : arguments) {
    if (!argument.empty()) command += " " + ShellWord(argument);
  }
  for (const RunFlag& flag : flags) {
    if (flag.is_given) command += " " + ShellWord("--" + flag.name + "=" + flag.value);
  }
  return command;
}

nlohmann::ordered_json GivenFlagsReport(const RunFlags& flags) {
  nlohmann::ordered_json names = nlohmann::ordered_json::array();
  for (const RunFlag& flag : flags) {
    if (flag.is_given) names.push_back(flag.name);
  }
  return names;
}

}  // namespace ceres_ed
