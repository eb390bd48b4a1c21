#include "ceres_ed/io/mesh/ply_reader.h"

#include <ceres_ed/io/mesh/ply_ascii.h>
#include <ceres_ed/io/mesh/ply_binary.h>
#include <ceres_ed/io/mesh/ply_header.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <utility>

namespace ceres_ed {
namespace {

// No header comes near it; keeps a large file of another kind from being read to its end.
constexpr std::size_t kMaxHeaderSize = 1 << 20;

}  // namespace

StatusOr<PlyDocument> ReadPly(const std::string& path) {
  std::ifstream file;
  const StatusOr<std::size_t> file_size = OpenRegularFile(path, &file);
  if (!file_size.ok()) return file_size.status();

  std::string start(std::min(*file_size, kMaxHeaderSize), '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  StatusOr<PlyHeader> header = ParsePlyHeader(path, start);
  if (!header.ok()) return header.status();
  file.close();

  Status status = Status::Ok();
  if (header->document.format == PlyFormat::kAscii) {
    const StatusOr<std::string> text = ReadWholeFile(path);
    if (!text.ok()) return text.status();
    const std::string_view body =
        std::string_view(*text).substr(std::min(header->size, text->size()));
    status = ReadPlyAsciiBody(path, body, header->num_lines, &header->document);
  } else {
    status = ReadPlyBinaryBody(path, *file_size, &*header);
  }
  if (!status.ok()) return status;
  return std::move(header->document);
}

}  // namespace ceres_ed
