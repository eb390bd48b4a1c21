// Files that grow row by row while a program runs.
#ifndef CERES_ED_IO_APPEND_FILE_H_
#define CERES_ED_IO_APPEND_FILE_H_

#include <ceres_ed/util/status.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace ceres_ed {

// A file to which rows are appended. Each Append() passes its text to the system at once and in one
// piece. So the file ends with a complete row even if the program is killed.
class AppendFile {
 public:
  // Has no file; Append() must not be called.
  AppendFile() = default;
  ~AppendFile();
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;

  // Creates an empty file at `path`, which replaces an old one. The error gives the system's
  // reason.
  static StatusOr<AppendFile> Create(const std::string& path);

  // Opens the file at `path` and cuts it to its first `size` bytes, so that more can be appended.
  // Returns an error if there is no file or if it is shorter.
  static StatusOr<AppendFile> Reopen(const std::string& path, std::int64_t size);

  // Appends `text`. The error gives the system's reason.
  Status Append(std::string_view text);

  bool is_open() const { return descriptor_ >= 0; }
  // The size of the file in bytes.
  std::int64_t size() const { return size_; }

 private:
  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_APPEND_FILE_H_
