#include "ceres_ed/io/atomic_file.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/util/process.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <streambuf>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ceres_ed {
namespace {

constexpr std::size_t kBufferSize = 1 << 16;
constexpr int kMaxNameAttempts = 1000;

// What stands between the name of a file and that of the process that writes it.
constexpr std::string_view kTemporary = ".tmp.";

}  // namespace

// A std::filebuf loses the errno of a failed write. This buffer keeps the first one.
class AtomicFile::Buffer : public std::streambuf {
 public:
  explicit Buffer(int descriptor) : descriptor_(descriptor), bytes_(kBufferSize) { ResetArea(); }
  ~Buffer() override { Close(); }

  int error() const { return error_; }

  bool Close() {
    if (descriptor_ >= 0) {
      sync();
      if (::close(descriptor_) != 0 && error_ == 0) error_ = errno;
      descriptor_ = -1;
    }
    return error_ == 0;
  }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  std::streamsize xsputn(const char* data, std::streamsize size) override {
    if (size <= epptr() - pptr()) {
      std::memcpy(pptr(), data, static_cast<std::size_t>(size));
      pbump(static_cast<int>(size));
      return size;
    }
    if (sync() != 0) return 0;
    return WriteAll(data, static_cast<std::size_t>(size)) ? size : 0;
  }

  int sync() override {
    const bool written = WriteAll(pbase(), static_cast<std::size_t>(pptr() - pbase()));
    ResetArea();
    return written ? 0 : -1;
  }

 private:
  void ResetArea() { setp(bytes_.data(), bytes_.data() + bytes_.size()); }

  bool WriteAll(const char* data, std::size_t size) {
    while (error_ == 0 && size > 0) {
      const ssize_t written = ::write(descriptor_, data, size);
      if (written < 0) {
        if (errno != EINTR) error_ = errno;
        continue;
      }
      data += written;
      size -= static_cast<std::size_t>(written);
    }
    return error_ == 0;
  }

  int descriptor_;
  int error_ = 0;
  std::vector<char> bytes_;
};

AtomicFile::AtomicFile() = default;

StatusOr<std::unique_ptr<AtomicFile>> AtomicFile::Create(const std::string& path) {
  if (path.empty()) return Status::Error("cannot write a file without a name");
  std::unique_ptr<AtomicFile> file(new AtomicFile);
  file->path_ = path;
  file->final_path_ = path;

  std::error_code no_such_file;
  const std::filesystem::path resolved = std::filesystem::canonical(path, no_such_file);
  if (!no_such_file) file->final_path_ = resolved.string();

  struct stat info;
  const bool exists = ::stat(path.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) return WriteError(path, EISDIR);
  // This is checked since a rename would replace a file that its owner has protected from writing.
  if (exists && ::access(path.c_str(), W_OK) != 0) return WriteError(path, errno);

  int descriptor = -1;
  if (exists && !S_ISREG(info.st_mode)) {
    descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    // mkstemp() is not used, since its files are private to the user, whatever the umask is.
    for (int attempt = 0; descriptor < 0 && attempt < kMaxNameAttempts; ++attempt) {
      file->temporary_path_ = file->final_path_ + TemporaryEnding() + "." + std::to_string(attempt);
      descriptor =
          ::open(file->temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor < 0 && errno != EEXIST) break;
    }
  }
  if (descriptor < 0) {
    const int error = errno;
    file->temporary_path_.clear();
    return WriteError(path, error);
  }
  file->buffer_ = std::make_unique<Buffer>(descriptor);
  file->stream_ = std::make_unique<std::ostream>(file->buffer_.get());
  return StatusOr<std::unique_ptr<AtomicFile>>(std::move(file));
}

AtomicFile::~AtomicFile() {
  if (buffer_ != nullptr) buffer_->Close();
  if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
}

std::ostream& AtomicFile::stream() { return *stream_; }

Status AtomicFile::Commit() {
  if (!buffer_->Close()) return WriteError(path_, buffer_->error());
  // The caller may have set the failure bits of the stream. The contents are then not complete.
  if (!stream_->good()) return Status::Error(path_ + ": cannot write: the contents are incomplete");
  if (temporary_path_.empty()) return Status::Ok();
  if (std::rename(temporary_path_.c_str(), final_path_.c_str()) != 0) {
    return WriteError(path_, errno);
  }
  temporary_path_.clear();
  return Status::Ok();
}

std::string TemporaryEnding() { return std::string(kTemporary) + ProcessName(); }

void RemoveAbandonedFiles(const std::string& folder) {
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator(folder, error);
       !error && entry != std::filesystem::end(entry);
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const std::size_t ending = name.rfind(kTemporary);
    std::string_view rest;
    if (ending == std::string::npos ||
        !IsAbandoned(std::string_view(name).substr(ending + kTemporary.size()), &rest)) {
      continue;
    }
    std::error_code ignored;
    std::filesystem::remove(entry->path(), ignored);
  }
}

Status WriteFileAtomically(const std::string& path, std::string_view contents) {
  StatusOr<std::unique_ptr<AtomicFile>> file = AtomicFile::Create(path);
  if (!file.ok()) return file.status();
  (*file)->stream().write(contents.data(), static_cast<std::streamsize>(contents.size()));
  return (*file)->Commit();
}

}  // namespace ceres_ed
