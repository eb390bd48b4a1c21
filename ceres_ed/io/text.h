// Helpers for reading text.
#ifndef CERES_ED_IO_TEXT_H_
#define CERES_ED_IO_TEXT_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace ceres_ed {

// Returns `text` in quotes for an error message. It is cut to 40 characters, and unprintable ones
// are replaced by '?'.
inline std::string Quoted(std::string_view text) {
  constexpr std::size_t kMaxLength = 40;
  std::string quoted = "'";
  for (const char c : text.substr(0, kMaxLength)) quoted += (c >= ' ' && c <= '~') ? c : '?';
  return quoted + (text.size() > kMaxLength ? "...'" : "'");
}

// Returns the number if all of `text` is one (`nan` and `inf` included), otherwise nothing. The
// result does not depend on the locale. A magnitude beyond the range of double becomes infinite or
// 0, with its sign.
std::optional<double> ParseDouble(std::string_view text);

// The following two functions return "PATH: cannot read: ..." and "PATH: cannot write: ..." with
// the system's reason for `error`, a value of errno.
Status ReadError(const std::string& path, int error);
Status WriteError(const std::string& path, int error);

// Returns the contents of a file. The error gives the system's reason. A directory, device or pipe
// is an error.
StatusOr<std::string> ReadWholeFile(const std::string& path);

// Opens `path` and returns its size in bytes. Errors are as those of ReadWholeFile().
StatusOr<std::size_t> OpenRegularFile(const std::string& path, std::ifstream* file);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_TEXT_H_
