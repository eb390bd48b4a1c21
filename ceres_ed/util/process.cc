#include "ceres_ed/util/process.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <system_error>

#include <unistd.h>

namespace ceres_ed {
namespace {

std::string HostPrefix() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "host.";
  return std::string(name.data()) + ".";
}

// Returns whether a process with this number exists. This process has just begun, and so what has
// its number is older.
bool IsAtWork(pid_t process) {
  return process != ::getpid() && (::kill(process, 0) == 0 || errno == EPERM);
}

}  // namespace

std::string ProcessName() { return HostPrefix() + std::to_string(::getpid()); }

bool IsAbandoned(std::string_view text, std::string_view* rest) {
  const std::string prefix = HostPrefix();
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  pid_t process = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), process);
  if (parsed.ec != std::errc() || process <= 0) return false;
  text.remove_prefix(static_cast<std::size_t>(parsed.ptr - text.data()));
  if (!text.empty() && text.front() != '.') return false;
  if (IsAtWork(process)) return false;
  *rest = text.empty() ? text : text.substr(1);
  return true;
}

}  // namespace ceres_ed
