#include "ceres_ed/pipeline/cohort/member_folder.h"

#include <ceres_ed/util/process.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

std::string WorkFolder(const std::string& output) { return output + "/.work"; }

}  // namespace

std::string MemberPath(const std::string& output, const std::string& name) {
  return output + "/members/" + name;
}

StatusOr<MemberFolder> MemberFolder::Create(const std::string& output, const std::string& name) {
  MemberFolder folder;
  const std::string path = WorkFolder(output) + "/" + ProcessName() + "." + name;
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
  for (auto entry = fs::directory_iterator(WorkFolder(output), error);
       !error && entry != fs::end(entry);
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::string_view member;
    if (!IsAbandoned(name, &member) || member.empty()) continue;
    names.emplace(member);
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
  }
  return names;
}

}  // namespace ceres_ed
