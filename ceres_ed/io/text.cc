#include "ceres_ed/io/text.h"

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <limits>
#include <system_error>

namespace ceres_ed {
namespace {

// from_chars does not set the value if it is out of range. The sign of the exponent tells whether
// it is too large or too small.
double OutOfRangeValue(std::string_view text) {
  const std::size_t exponent = text.find_first_of("eE");
  const bool tiny =
      exponent != std::string_view::npos && exponent + 1 < text.size() && text[exponent + 1] == '-';
  const double magnitude = tiny ? 0.0 : std::numeric_limits<double>::infinity();
  return text[0] == '-' ? -magnitude : magnitude;
}

}  // namespace

std::optional<double> ParseDouble(std::string_view text) {
  // from_chars does not accept a plus sign, but printf("%+g") writes one.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ptr != end) return std::nullopt;
  if (result.ec == std::errc::result_out_of_range) return OutOfRangeValue(text);
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

Status ReadError(const std::string& path, int error) {
  return Status::Error(path + ": cannot read: " + std::generic_category().message(error));
}

Status WriteError(const std::string& path, int error) {
  return Status::Error(path + ": cannot write: " + std::generic_category().message(error));
}

StatusOr<std::size_t> OpenRegularFile(const std::string& path, std::ifstream* file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (error || !std::filesystem::exists(status)) {
    return ReadError(path, error ? error.value() : ENOENT);
  }
  if (std::filesystem::is_directory(status)) {
    return Status::Error(path + ": is a directory, expected a file");
  }
  if (!std::filesystem::is_regular_file(status)) {
    return Status::Error(path + ": is a device or a pipe, expected a regular file");
  }
  errno = 0;
  file->open(path, std::ios::binary);
  if (!*file) return ReadError(path, errno);
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return ReadError(path, error.value());
  return static_cast<std::size_t>(size);
}

StatusOr<std::string> ReadWholeFile(const std::string& path) {
  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(path, &file);
  if (!size.ok()) return size.status();
  std::string contents(*size, '\0');
  file.read(contents.data(), static_cast<std::streamsize>(contents.size()));
  if (static_cast<std::size_t>(file.gcount()) != contents.size()) {
    return Status::Error(path + ": cannot read: it ends ahead of its size");
  }
  return contents;
}

}  // namespace ceres_ed
