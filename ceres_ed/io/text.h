// Small helpers for readers of text.
#ifndef CERES_ED_IO_TEXT_H_
#define CERES_ED_IO_TEXT_H_

#include <ceres_ed/util/status.h>

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace ceres_ed {

// `text` in quotes for an error sentence: cut to 40 characters, unprintable ones as '?'.
inline std::string Quoted(std::string_view text) {
  constexpr std::size_t kMaxLength = 40;
  std::string quoted = "'";
  for (const char c : text.substr(0, kMaxLength)) quoted += (c >= ' ' && c <= '~') ? c : '?';
  return quoted + (text.size() > kMaxLength ? "...'" : "'");
}

// The number that `text` is as a whole (`nan` and `inf` too), or nothing. Independent of the
// locale. A magnitude beyond the range of double becomes infinite or 0, with its sign.
std::optional<double> ParseDouble(std::string_view text);

// "PATH: cannot read: ..." and "PATH: cannot write: ..." with the system's reason for `error`, a
// value of errno.
Status ReadError(const std::string& path, int error);
Status WriteError(const std::string& path, int error);

// The whole file, or an error with the system's reason. A directory, device or pipe is an error.
StatusOr<std::string> ReadWholeFile(const std::string& path);

// Opens `path` and tells its size in bytes; errors as of ReadWholeFile.
StatusOr<std::size_t> OpenRegularFile(const std::string& path, std::ifstream* file);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_TEXT_H_
