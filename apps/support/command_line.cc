#include "apps/support/command_line.h"

#include <ceres_ed/linear_algebra/linear_algebra_backend.h>
#include <ceres_ed/version.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <thread>

namespace ceres_ed {
namespace {

constexpr int kHelpColumns = 100;
constexpr int kMaxFlagFileDepth = 8;

// Every flag of a program is defined under the folder that this file's folder is in.
std::string_view AppsFolder() {
  constexpr std::string_view kThisFile = __FILE__;
  constexpr std::string_view kPathInApps = "support/command_line.cc";
  return kThisFile.substr(0, kThisFile.size() - kPathInApps.size());
}

bool StartsWith(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

bool EndsWith(std::string_view text, std::string_view suffix) {
  return text.size() >= suffix.size() && text.substr(text.size() - suffix.size()) == suffix;
}

bool IsOwnFlag(const gflags::CommandLineFlagInfo& flag) {
  return StartsWith(flag.filename, AppsFolder());
}

// gflags brings twenty flags for help, completion and the environment, none of which works here.
bool IsGflagsHelper(const gflags::CommandLineFlagInfo& flag) {
  return EndsWith(flag.filename, "gflags.cc") || EndsWith(flag.filename, "gflags_reporting.cc") ||
         EndsWith(flag.filename, "gflags_completions.cc");
}

bool FindFlag(const std::string& name, gflags::CommandLineFlagInfo* flag) {
  return gflags::GetCommandLineFlagInfo(name.c_str(), flag) && !IsGflagsHelper(*flag);
}

std::string TypeName(const gflags::CommandLineFlagInfo& flag) {
  if (flag.type == "bool") return "true|false";
  if (flag.type == "string") return "text";
  return flag.type == "double" ? "number" : "integer";
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
  // `word` begins with a dash. A flag in a file has its value behind `=` (depth > 0).
  Status TakeFlag(const std::string& word, int depth) {
    const std::size_t start = word[1] == '-' ? 2 : 1;
    const std::size_t equals = word.find('=');
    const bool has_value = equals != std::string::npos;
    std::string name = word.substr(start, has_value ? equals - start : std::string::npos);
    std::string value = has_value ? word.substr(equals + 1) : "";
    if (!has_value && (name == "help" || name == "h" || name == "version")) {
      result_.request =
          name == "version" ? CommandLine::Request::kVersion : CommandLine::Request::kHelp;
      return Status::Ok();
    }

    gflags::CommandLineFlagInfo flag;
    const bool is_file = name == "flagfile";
    if (!is_file && !FindFlag(name, &flag)) {
      const bool negated = !has_value && StartsWith(name, "no") &&
                           FindFlag(name.substr(2), &flag) && flag.type == "bool";
      if (!negated) return Status::Error("unknown flag --" + name);
      return SetFlag(flag, "false");
    }
    if (!has_value) {
      if (flag.type == "bool") return SetFlag(flag, "true");
      if (depth > 0 || next_ >= words_.size()) {
        return Status::Error("flag --" + name + " needs a value");
      }
      value = words_[next_++];
    }
    return is_file ? TakeFile(value, depth + 1) : SetFlag(flag, value);
  }

  // One flag a line; empty lines and lines that begin with # say nothing.
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

  Status SetFlag(const gflags::CommandLineFlagInfo& flag, const std::string& value) {
    const bool is_nan = flag.type == "double" && std::isnan(std::strtod(value.c_str(), nullptr));
    if (is_nan || gflags::SetCommandLineOption(flag.name.c_str(), value.c_str()).empty()) {
      return Status::Error("bad value --" + flag.name + "=" + value + ", expected " +
                           TypeName(flag));
    }
    return Status::Ok();
  }

  std::vector<std::string> words_;
  std::size_t next_ = 0;
  CommandLine result_;
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

std::string ShortValue(const gflags::CommandLineFlagInfo& flag, const std::string& value) {
  if (flag.type != "double") return value;
  constexpr int kLongestDouble = 64;
  char text[kLongestDouble];
  const double number = std::strtod(value.c_str(), nullptr);
  return std::string(text, std::to_chars(text, text + kLongestDouble, number).ptr);
}

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
    return Status::Error(std::to_string(count) + " arguments given, expected " +
                         ArgumentCountText(info) + ": " + info.name + " " + info.arguments);
  }
  return parsed;
}

std::string HelpText(const ProgramInfo& info) {
  std::string text = "Usage: " + info.name + " " + info.arguments + "\n\n" +
                     Wrap(info.description, 0, kHelpColumns) + "\n\nFlags [default]:\n";
  const std::vector<gflags::CommandLineFlagInfo> flags = OwnFlags();
  std::size_t name_width = 0;
  for (const auto& flag : flags) name_width = std::max(name_width, flag.name.size());
  constexpr int kTypeWidth = 10;
  const int indent = static_cast<int>(name_width) + kTypeWidth + 6;
  for (const auto& flag : flags) {
    const std::string type = TypeName(flag);
    const std::string fallback =
        flag.default_value.empty() ? "" : " [" + ShortValue(flag, flag.default_value) + "]";
    text += "  --" + flag.name + std::string(name_width - flag.name.size() + 1, ' ') + type +
            std::string(kTypeWidth - type.size() + 1, ' ') +
            Wrap(flag.description + fallback, indent, kHelpColumns - indent) + "\n";
  }
  return text + "\nExample: " + info.example + "\n";
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
  return ShortValue(flag, flag.current_value);
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
