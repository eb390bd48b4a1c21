#include "apps/support/program.h"

#include <ceres_ed/util/shown_text.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include <apps/support/command_line.h>
#include <glog/logging.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace ceres_ed {
namespace {

// Makes glibc keep memory that was freed. Frames and rounds need the same memory again and again.
// Otherwise glibc would return it to the system each time and then request it again page by page,
// which is slow in a virtual machine. The settings apply to the whole process, so the programs make
// them, and the library does not.
void ConfigureMemory() {
#ifdef __GLIBC__
  constexpr int kNever = 1 << 30;
  constexpr int kHeapStep = 16 << 20;
  // NOLINTBEGIN(concurrency-mt-unsafe): there is only one thread so far.
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TOP_PAD, kHeapStep);
  // NOLINTEND(concurrency-mt-unsafe)
#endif
}

// A global variable, because a signal handler cannot reach anything else.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not wait for a lock");

extern "C" void HandleStopSignal(int) {
  stop_requested = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

void ConfigureLogging(const char* program) {
  FLAGS_logtostderr = true;
  FLAGS_log_prefix = false;
  FLAGS_minloglevel = google::GLOG_WARNING;
  google::InitGoogleLogging(program);
}

Outcome RunGuarded(const std::function<Outcome(const std::vector<std::string>&)>& body,
                   const std::vector<std::string>& arguments) {
  try {
    return body(arguments);
  } catch (const std::bad_alloc&) {
    return Outcome::NoResult(Status::Error("out of memory"));
  } catch (const std::exception& error) {
    return Outcome::NoResult(Status::Error(std::string("unexpected error: ") + error.what()));
  }
}

Outcome ParseAndRun(const ProgramInfo& info,
                    int argc,
                    char** argv,
                    const std::function<Outcome(const std::vector<std::string>&)>& body) {
  const StatusOr<CommandLine> command_line = ParseCommandLine(info, argc, argv);
  if (!command_line.ok()) return Outcome::Usage(command_line.status().message());
  switch (command_line->request) {
    case CommandLine::Request::kHelp:
      std::fputs(command_line->help->text(info).c_str(), stdout);
      return Outcome::Done();
    case CommandLine::Request::kVersion:
      std::fputs(VersionText().c_str(), stdout);
      return Outcome::Done();
    case CommandLine::Request::kRun:
      break;
  }
  return RunGuarded(body, command_line->arguments);
}

}  // namespace

int RunProgram(const ProgramInfo& info,
               int argc,
               char** argv,
               const std::function<Outcome(const std::vector<std::string>& arguments)>& body) {
  ConfigureMemory();
  ConfigureLogging(argv[0]);
  Outcome outcome = ParseAndRun(info, argc, argv, body);
  if (std::fflush(stdout) != 0 && outcome.code == ExitCode::kDone) {
    outcome = Outcome::BadInput(Status::Error("standard output cannot be written"));
  }
  if (outcome.code != ExitCode::kDone) {
    std::string line = info.name + ": " + outcome.message;
    std::replace(line.begin(), line.end(), '\n', ' ');
    if (outcome.code == ExitCode::kUsage)
      line += line.back() == '?' ? " (see --help)" : "; see --help";
    std::fprintf(stderr, "%s\n", ShownText(line).c_str());
  }
  return static_cast<int>(outcome.code);
}

void InstallStopHandler() {
  std::signal(SIGTERM, HandleStopSignal);
  // A shell starts background jobs with SIGINT ignored, because Ctrl-C is meant for other programs.
  if (std::signal(SIGINT, HandleStopSignal) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}

bool StopRequested() { return stop_requested; }

}  // namespace ceres_ed
