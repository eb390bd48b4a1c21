#include "ceres_ed/vtk/trial_run.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

void Silence() {
  const int nothing = open("/dev/null", O_WRONLY);
  if (nothing < 0) return;
  dup2(nothing, STDOUT_FILENO);
  dup2(nothing, STDERR_FILENO);
}

// Lets this process take only so many bytes more. Sanitizers, which reserve terabytes, have limits
// of their own.
void LimitMemory(std::size_t more_bytes) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  if (pages == 0) return;
  const auto page_size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  constexpr std::size_t kTerabyte = std::size_t{1} << 40U;
  if (pages * page_size > kTerabyte) return;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, pages * page_size + more_bytes);
  setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

bool EndsWell(const std::function<bool()>& code, std::size_t more_bytes) {
  const pid_t child = fork();
  if (child < 0) return true;
  if (child == 0) {
    Silence();
    const rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    // Handlers of the program, for example those that print a trace, have no use here.
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) {
      std::signal(number, SIG_DFL);
    }
    LimitMemory(more_bytes);
    bool is_well = true;
    try {
      is_well = code();
    } catch (const std::bad_alloc&) {
      is_well = false;
    } catch (...) {
      // The caller meets the exception itself.
    }
    _exit(is_well ? 0 : 1);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return true;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace ceres_ed
