#include "ceres_ed/pipeline/cohort/member_folder.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

std::string HostName() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
  return name.data();
}

std::string WorkFolder(const std::string& output) { return output + "/.work"; }

// Returns "HOST.", with which the names of folders of this machine begin.
std::string HostPrefix() { return HostName() + "."; }

// Returns whether a process with this number exists. This process has just begun, and so what has
// its number is older.
bool IsAtWork(pid_t process) {
  return process != ::getpid() && (::kill(process, 0) == 0 || errno == EPERM);
}

}  // namespace

std::string MemberPath(const std::string& output, const std::string& name) {
  return output + "/members/" + name;
}

StatusOr<MemberFolder> MemberFolder::Create(const std::string& output, const std::string& name) {
  MemberFolder folder;
  const std::string path =
      WorkFolder(output) + "/" + HostPrefix() + std::to_string(::getpid()) + "." + name;
  folder.final_path_ = MemberPath(output, name);
  std::error_code error;
  fs::remove_all(path, error);
  fs::create_directories(path, error);
  if (!error) fs::create_directories(fs::path(folder.final_path_).parent_path(), error);
  if (error) return Status::Error(path + ": the folder cannot be made: " + error.message());
  folder.path_ = path;
  return StatusOr<MemberFolder>(std::move(folder));
}

MemberFolder::MemberFolder(MemberFolder&& other) noexcept
    : path_(std::exchange(other.path_, "")), final_path_(std::move(other.final_path_)) {}

MemberFolder::~MemberFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

Status MemberFolder::Commit() {
  std::error_code error;
  // A folder is not replaced by a rename unless it is empty. The old one gets out of the way first.
  const std::string old = path_ + "~";
  if (fs::exists(final_path_, error)) {
    fs::remove_all(old, error);
    fs::rename(final_path_, old, error);
  }
  fs::rename(path_, final_path_, error);
  if (error) {
    return Status::Error(final_path_ + ": cannot be written: " + error.message());
  }
  path_.clear();
  fs::remove_all(old, error);
  return Status::Ok();
}

std::set<std::string> RemoveAbandonedWork(const std::string& output) {
  std::set<std::string> names;
  std::error_code error;
  const std::string prefix = HostPrefix();
  for (auto entry = fs::directory_iterator(WorkFolder(output), error);
       !error && entry != fs::end(entry);
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.rfind(prefix, 0) != 0) continue;
    long process = 0;
    const char* const end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + prefix.size(), end, process);
    if (parsed.ec != std::errc() || parsed.ptr == end || *parsed.ptr != '.') continue;
    if (IsAtWork(static_cast<pid_t>(process))) continue;
    names.insert(parsed.ptr + 1);
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
  }
  return names;
}

}  // namespace ceres_ed
