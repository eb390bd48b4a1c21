// Files that grow row by row while a program runs.
#ifndef CERES_ED_IO_APPEND_FILE_H_
#define CERES_ED_IO_APPEND_FILE_H_

#include <ceres_ed/util/status.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace ceres_ed {

// Each Append() is handed to the system at once and in one piece: whatever kills the program, the
// file ends with a whole row.
class AppendFile {
 public:
  // No file: Append() must not be called.
  AppendFile() = default;
  ~AppendFile();
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;

  // Returns an empty file at `path`, in the place of an old one, or an error with the system's
  // reason.
  static StatusOr<AppendFile> Create(const std::string& path);

  // Returns the file at `path`, cut to its first `size` bytes, to go on with. Error: there is none,
  // or it is shorter.
  static StatusOr<AppendFile> Reopen(const std::string& path, std::int64_t size);

  // Returns ok when the system has all of `text`; else an error with its reason.
  Status Append(std::string_view text);

  bool is_open() const { return descriptor_ >= 0; }
  // Bytes in the file.
  std::int64_t size() const { return size_; }

 private:
  std::string path_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_APPEND_FILE_H_
