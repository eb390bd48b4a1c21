#include "ceres_ed/io/append_file.h"

#include <ceres_ed/io/text.h>

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <glog/logging.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

// Removes a symbolic link to a regular file, or to nothing: the file that is created must not
// overwrite one that lies elsewhere. Links to devices and pipes stay.
Status RemoveLinkToFile(const std::string& path) {
  struct stat link;
  if (::lstat(path.c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) return Status::Ok();
  struct stat target;
  if (::stat(path.c_str(), &target) == 0 && !S_ISREG(target.st_mode)) return Status::Ok();
  return ::unlink(path.c_str()) == 0 ? Status::Ok() : WriteError(path, errno);
}

}  // namespace

AppendFile::~AppendFile() {
  if (is_open()) ::close(descriptor_);
}

AppendFile::AppendFile(AppendFile&& other) noexcept { *this = std::move(other); }

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

StatusOr<AppendFile> AppendFile::Create(const std::string& path) {
  AppendFile file;
  file.path_ = path;
  if (Status status = RemoveLinkToFile(path); !status.ok()) return status;
  file.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (!file.is_open()) return WriteError(path, errno);
  return file;
}

StatusOr<AppendFile> AppendFile::Reopen(const std::string& path, std::int64_t size) {
  AppendFile file;
  file.path_ = path;
  file.descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  struct stat info;
  if (!file.is_open() || ::fstat(file.descriptor_, &info) != 0) return WriteError(path, errno);
  if (info.st_size < size) {
    return Status::Error(path + ": has " + std::to_string(info.st_size) + " bytes, expected the " +
                         std::to_string(size) + " that were there before");
  }
  if (::ftruncate(file.descriptor_, size) != 0 || ::lseek(file.descriptor_, 0, SEEK_END) != size) {
    return WriteError(path, errno);
  }
  file.size_ = size;
  return file;
}

Status AppendFile::Append(std::string_view text) {
  CHECK(is_open());
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return WriteError(path_, errno);
    text.remove_prefix(static_cast<std::size_t>(written));
    size_ += written;
  }
  return Status::Ok();
}

}  // namespace ceres_ed
