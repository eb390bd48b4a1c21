#include "ceres_ed/io/mesh/mesh_format.h"

#include <ceres_ed/io/mesh/pcd_file.h>
#include <ceres_ed/io/mesh/ply_reader.h>
#include <ceres_ed/io/mesh/ply_writer.h>

#include <algorithm>
#include <filesystem>

namespace ceres_ed {
namespace {

// The first one is used for all other endings.
constexpr MeshFormat kFormats[] = {
    {".ply", ReadPly, WritePly},
    {".pcd", ReadPcd, WritePcd},
};

}  // namespace

const MeshFormat& MeshFormatOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const MeshFormat& format : kFormats) {
    if (ending == format.ending) return format;
  }
  return kFormats[0];
}

StatusOr<PlyDocument> ReadMesh(const std::string& path) { return MeshFormatOf(path).read(path); }

Status WriteMesh(const std::string& path, const PlyDocument& document) {
  return MeshFormatOf(path).write(path, document);
}

}  // namespace ceres_ed
