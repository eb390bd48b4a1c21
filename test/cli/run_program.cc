#include "test/cli/run_program.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <glog/logging.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

using Clock = std::chrono::steady_clock;

// A nameless file: unlike a pipe it never fills up, so nobody has to read while the program runs.
struct OutputFile {
  OutputFile() : stream(std::tmpfile()) { PCHECK(stream != nullptr); }
  ~OutputFile() { std::fclose(stream); }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::string Contents() const {
    std::string text;
    char buffer[4096];
    std::rewind(stream);
    while (const std::size_t size = std::fread(buffer, 1, sizeof(buffer), stream)) {
      text.append(buffer, size);
    }
    return text;
  }

  std::FILE* stream;
};

// Between fork and exec: nothing here may allocate.
[[noreturn]] void ExecInChild(
    const char* program, char* const* argv, const char* directory, int out, int err) {
  // Background jobs inherit an ignored SIGINT; the program under test shall not.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const bool ready = dup2(null, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0 &&
                     dup2(err, STDERR_FILENO) >= 0 &&
                     (directory == nullptr || chdir(directory) == 0);
  if (ready) execv(program, argv);
  _exit(127);
}

// Waits for the child, sends what the options ask for, and kills it at the end of its time.
int Wait(pid_t child, const RunOptions& options, bool* timed_out) {
  const auto start = Clock::now();
  const auto elapsed = [start] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  bool signal_pending = options.signal != 0;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (signal_pending && elapsed() >= options.signal_after_s &&
        (!options.signal_when || options.signal_when())) {
      kill(child, options.signal);
      signal_pending = false;
    }
    if (!*timed_out && elapsed() > options.timeout_s) {
      kill(child, SIGKILL);
      *timed_out = true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return status;
}

// The words as execv() takes them.
std::vector<char*> PointersTo(std::vector<std::string>* words) {
  std::vector<char*> pointers;
  for (std::string& word : *words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

ProgramResult RunProgramFile(const std::string& program,
                             const std::vector<std::string>& arguments,
                             const RunOptions& options) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::vector<char*> argv = PointersTo(&words);
  const char* directory =
      options.working_directory.empty() ? nullptr : options.working_directory.c_str();

  const OutputFile out;
  const OutputFile err;
  const pid_t child = fork();
  PCHECK(child >= 0);
  if (child == 0) {
    ExecInChild(program.c_str(), argv.data(), directory, fileno(out.stream), fileno(err.stream));
  }

  ProgramResult result;
  const int status = Wait(child, options, &result.timed_out);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.out = out.Contents();
  result.err = err.Contents();
  return result;
}

bool HasTerminals() {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0) return false;
  const bool usable = grantpt(terminal) == 0 && unlockpt(terminal) == 0;
  close(terminal);
  return usable;
}

ProgramResult RunOnTerminal(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::vector<char*> argv = PointersTo(&words);
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  PCHECK(child >= 0);
  if (child == 0) {
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  ProgramResult result;
  char buffer[4096];
  // Reading fails when the program has closed its end.
  for (ssize_t size = 0; (size = read(terminal, buffer, sizeof(buffer))) > 0;) {
    result.out.append(buffer, static_cast<std::size_t>(size));
  }
  int status = 0;
  PCHECK(waitpid(child, &status, 0) == child);
  close(terminal);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

std::string AppPath(const std::string& name) { return std::string(CERES_ED_APPS_DIR) + "/" + name; }

std::vector<std::string> SplitLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace ceres_ed
