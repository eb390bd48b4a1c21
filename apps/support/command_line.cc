#include "apps/support/command_line.h"

#include <ceres_ed/linear_algebra/linear_algebra_backend.h>
#include <ceres_ed/util/nearest_word.h>
#include <ceres_ed/version.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string_view>
#include <thread>

#include <apps/support/help/flag_text.h>
#include <apps/support/option_flags.h>

namespace ceres_ed {
namespace {

constexpr int kMaxFlagFileDepth = 8;

bool StartsWith(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

bool EndsWith(std::string_view text, std::string_view suffix) {
  return text.size() >= suffix.size() && text.substr(text.size() - suffix.size()) == suffix;
}

bool IsOwnFlag(const gflags::CommandLineFlagInfo& flag) {
  return flag.filename == kOptionFlagsFile;
}

// gflags defines twenty flags for help, completion and the environment. None of them works here.
bool IsGflagsHelper(const gflags::CommandLineFlagInfo& flag) {
  return EndsWith(flag.filename, "gflags.cc") || EndsWith(flag.filename, "gflags_reporting.cc") ||
         EndsWith(flag.filename, "gflags_completions.cc");
}

// Finds a flag by its name or its letter.
bool FindFlag(const std::string& name, gflags::CommandLineFlagInfo* flag) {
  const OptionFlag* option = FindOptionFlag(name);
  const std::string& full_name = option != nullptr ? option->option->name : name;
  return gflags::GetCommandLineFlagInfo(full_name.c_str(), flag) && !IsGflagsHelper(*flag);
}

Status UnknownFlag(const std::string& name) {
  std::vector<std::string> known = {"help", "version"};
  for (const OptionFlag* flag : RegisteredOptionFlags()) known.push_back(flag->option->name);
  const std::string nearest = NearestWord(name, known);
  return Status::Error("unknown flag --" + name +
                       (nearest.empty() ? "" : ", did you mean --" + nearest + "?"));
}

// Returns the text of the number for which `word` stands on a flag; nothing if it is not such a
// word.
std::optional<std::string> ValueOfWord(const std::string& flag, const std::string& word) {
  const OptionFlag* option = FindOptionFlag(flag);
  if (option == nullptr) return std::nullopt;
  for (const SpecialValue& special : option->option->specials) {
    if (word == special.word) return NumberText(special.on_flag);
  }
  return std::nullopt;
}

class Parser {
 public:
  Parser(int argc, const char* const* argv) : words_(argv + 1, argv + argc) {}

  StatusOr<CommandLine> Parse() {
    bool flags_ended = false;
    while (next_ < words_.size() && result_.request == CommandLine::Request::kRun) {
      const std::string word = words_[next_++];
      if (flags_ended || word.size() < 2 || word[0] != '-') {
        result_.arguments.push_back(word);
      } else if (word == "--") {
        flags_ended = true;
      } else if (Status status = TakeFlag(word, 0); !status.ok()) {
        return status;
      }
    }
    return result_;
  }

 private:
  // Sets the flag in `word`, which begins with a dash. In a file (depth > 0), the value must follow
  // `=`.
  Status TakeFlag(const std::string& word, int depth) {
    const std::size_t start = word[1] == '-' ? 2 : 1;
    const std::size_t equals = word.find('=');
    const bool has_value = equals != std::string::npos;
    std::string name = word.substr(start, has_value ? equals - start : std::string::npos);
    std::string value = has_value ? word.substr(equals + 1) : "";
    if (name == "help" || name == "h") return TakeHelp(value);
    if (name == "version" && !has_value) {
      result_.request = CommandLine::Request::kVersion;
      return Status::Ok();
    }

    gflags::CommandLineFlagInfo flag;
    const bool is_file = name == "flagfile";
    if (!is_file && !FindFlag(name, &flag)) {
      const bool negated = !has_value && StartsWith(name, "no") &&
                           FindFlag(name.substr(2), &flag) && flag.type == "bool";
      if (!negated) return UnknownFlag(name);
      return SetFlag(flag, "false");
    }
    if (!has_value) {
      if (flag.type == "bool") return SetFlag(flag, "true");
      const OptionFlag* option = FindOptionFlag(name);
      if (option != nullptr && !option->option->text_alone.empty()) {
        return SetFlag(flag, option->option->text_alone);
      }
      if (depth > 0 || next_ >= words_.size()) {
        return Status::Error("flag --" + name + " needs a value");
      }
      value = words_[next_++];
    }
    return is_file ? TakeFile(value, depth + 1) : SetFlag(flag, value);
  }

  Status TakeHelp(const std::string& scope) {
    result_.help = FindHelpFormat(scope);
    if (result_.help == nullptr) return Status::Error("--help=" + scope + ", expected all");
    result_.request = CommandLine::Request::kHelp;
    return Status::Ok();
  }

  // Sets the flags in a file with one flag in each line. Lines that are empty or begin with # are
  // skipped.
  Status TakeFile(const std::string& path, int depth) {
    if (depth > kMaxFlagFileDepth) {
      return Status::Error("--flagfile=" + path + ": flag files name one another in a circle");
    }
    std::ifstream file(path);
    if (!file) return Status::Error("--flagfile=" + path + ": cannot be read");
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
      const std::size_t begin = line.find_first_not_of(" \t\r");
      if (begin == std::string::npos || line[begin] == '#') continue;
      const std::string word = line.substr(begin, line.find_last_not_of(" \t\r") + 1 - begin);
      Status status = word.size() > 1 && word[0] == '-'
                          ? TakeFlag(word, depth)
                          : Status::Error("'" + word + "', expected --flag=value");
      if (!status.ok()) {
        return Status::Error(path + ", line " + std::to_string(number) + ": " + status.message());
      }
    }
    return Status::Ok();
  }

  Status SetFlag(const gflags::CommandLineFlagInfo& flag, const std::string& given) {
    const std::string value = ValueOfWord(flag.name, given).value_or(given);
    const bool is_nan = flag.type == "double" && std::isnan(std::strtod(value.c_str(), nullptr));
    if (is_nan || gflags::SetCommandLineOption(flag.name.c_str(), value.c_str()).empty()) {
      return Status::Error("bad value --" + flag.name + "=" + value + ", expected " +
                           TypeText(flag));
    }
    return Status::Ok();
  }

  std::vector<std::string> words_;
  std::size_t next_ = 0;
  CommandLine result_;
};

std::string ArgumentCountText(const ProgramInfo& info) {
  if (info.min_arguments == info.max_arguments) return std::to_string(info.min_arguments);
  return std::to_string(info.min_arguments) + " to " + std::to_string(info.max_arguments);
}

}  // namespace

StatusOr<CommandLine> ParseCommandLine(const ProgramInfo& info, int argc, const char* const* argv) {
  StatusOr<CommandLine> parsed = Parser(argc, argv).Parse();
  if (!parsed.ok() || parsed->request != CommandLine::Request::kRun) return parsed;
  const int count = static_cast<int>(parsed->arguments.size());
  if (count < info.min_arguments || count > info.max_arguments) {
    // A file too many is likely to be that of the output.
    gflags::CommandLineFlagInfo output;
    const bool is_output = count == info.max_arguments + 1 && FindFlag("output", &output) &&
                           output.current_value.empty();
    return Status::Error(
        std::to_string(count) + " arguments given, expected " + ArgumentCountText(info) + ": " +
        info.name + " " + info.arguments +
        (is_output ? "; did you mean --output=" + parsed->arguments.back() + "?" : ""));
  }
  return parsed;
}

std::string VersionText() {
  const LinearAlgebraBackend backend = DescribeBackend();
  return std::string("ceres_ed ") + kVersion + "\nCeres " + backend.ceres_version +
         "\nsparse library " + backend.sparse_library + "\nordering library " +
         backend.ordering_library + "\nBLAS " + backend.blas + "\nvector kernels " +
         backend.kernels + "\nthreads " + std::to_string(std::thread::hardware_concurrency()) +
         "\n";
}

std::string CurrentValue(const std::string& name) {
  const gflags::CommandLineFlagInfo flag = gflags::GetCommandLineFlagInfoOrDie(name.c_str());
  return ValueText(flag, flag.current_value);
}

std::vector<gflags::CommandLineFlagInfo> OwnFlags() {
  std::vector<gflags::CommandLineFlagInfo> all;
  gflags::GetAllFlags(&all);
  std::vector<gflags::CommandLineFlagInfo> own;
  for (const auto& flag : all) {
    if (IsOwnFlag(flag)) own.push_back(flag);
  }
  return own;
}

}  // namespace ceres_ed
