#include "ceres_ed/io/mesh/ply_reader.h"

#include <ceres_ed/io/mesh/ply_ascii.h>
#include <ceres_ed/io/mesh/ply_binary.h>
#include <ceres_ed/io/mesh/ply_header.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <fstream>
#include <utility>

namespace ceres_ed {
namespace {

// Every header is much smaller than this. The limit keeps a large file of another kind from being
// read to its end.
constexpr std::size_t kMaxHeaderSize = 1 << 20;

// Returns the next `size` bytes of the file. There are fewer if it ends, which the readers of
// bodies notice.
std::string ReadBytes(std::size_t size, std::ifstream* file) {
  std::string bytes(size, '\0');
  file->read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file->gcount()));
  return bytes;
}

}  // namespace

StatusOr<PlyDocument> ReadPly(const std::string& path) {
  std::ifstream file;
  const StatusOr<std::size_t> file_size = OpenRegularFile(path, &file);
  if (!file_size.ok()) return file_size.status();

  const std::string start = ReadBytes(std::min(*file_size, kMaxHeaderSize), &file);
  StatusOr<PlyHeader> header = ParsePlyHeader(path, start);
  if (!header.ok()) return header.status();
  file.clear();
  file.seekg(static_cast<std::streamoff>(header->size));
  const std::string body = ReadBytes(*file_size - std::min(*file_size, header->size), &file);
  const Status status = header->document.format == PlyFormat::kAscii
                            ? ReadPlyAsciiBody(path, body, &*header)
                            : ReadPlyBinaryBody(path, body, &header->document);
  if (!status.ok()) return status;
  return std::move(header->document);
}

}  // namespace ceres_ed
