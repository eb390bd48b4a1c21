#include "ceres_ed/io/field/file_start.h"

#include <ceres_ed/io/field/gzip_reader.h>
#include <ceres_ed/io/text.h>

#include <fstream>

namespace ceres_ed {

StatusOr<std::string> ReadStart(const std::string& path, std::size_t size) {
  std::ifstream file;
  const StatusOr<std::size_t> in_file = OpenRegularFile(path, &file);
  if (!in_file.ok()) return in_file.status();
  std::string bytes(std::min(size, *in_file), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  const bool is_compressed = bytes.size() > 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b';
  return is_compressed ? GunzipStart(path, bytes, size) : bytes;
}

}  // namespace ceres_ed
