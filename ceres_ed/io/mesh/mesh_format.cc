#include "ceres_ed/io/mesh/mesh_format.h"

#include <ceres_ed/io/mesh/format_content.h>
#include <ceres_ed/io/mesh/gltf_file.h>
#include <ceres_ed/io/mesh/mesh_space.h>
#include <ceres_ed/io/mesh/obj_file.h>
#include <ceres_ed/io/mesh/off_file.h>
#include <ceres_ed/io/mesh/pcd_file.h>
#include <ceres_ed/io/mesh/ply_reader.h>
#include <ceres_ed/io/mesh/ply_writer.h>
#include <ceres_ed/io/mesh/stl_file.h>
#include <ceres_ed/io/mesh/vtk_file.h>
#include <ceres_ed/io/text.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace ceres_ed {
namespace {

constexpr std::string_view kNormalsAndRgb = "nx ny nz normal_x normal_y normal_z red green blue";
constexpr std::string_view kNormalsAndColors =
    "nx ny nz normal_x normal_y normal_z red green blue alpha";

// Formats are recognised in this order. The first one is used for names without an ending.
constexpr MeshFormat kFormats[] = {
    {".ply", "PLY", IsPly, ReadPly, WritePly, {true, true, true, "*", "*", "*"}},
    {".pcd", "PCD", IsPcd, ReadPcd, WritePcd, {true, false, true, "*", "", "", "", false}},
    {".vtp", "VTP", IsVtp, ReadVtk, WriteVtk, {true, true, true, "*", "*", "edge"}},
    {".vtk", "VTK", IsVtk, ReadVtk, WriteVtk, {true, true, true, "*", "*", "edge"}},
    {".glb", "GLB", IsGlb, ReadGlb, WriteGlb, {false, false, true, "*", "", ""}},
    {".off",
     "OFF",
     IsOff,
     ReadOff,
     WriteOff,
     {true, true, true, kNormalsAndColors, "red green blue alpha", ""}},
    {".stl", "STL", IsStl, ReadStl, WriteStl, {false, false, false, "", "attribute", "", "group"}},
    {".obj",
     "OBJ",
     IsObj,
     ReadObj,
     WriteObj,
     {true, true, true, kNormalsAndRgb, "texture_indices group", "edge texture_vertex"}},
};

std::string EndingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return ending;
}

// What the first bytes of a file say.
struct Content {
  // Null if no format recognises them.
  const MeshFormat* format = nullptr;
  // See mesh_space.h.
  std::string space_mark;
};

StatusOr<Content> Recognise(const std::string& path) {
  std::ifstream file;
  const StatusOr<std::size_t> size = OpenRegularFile(path, &file);
  if (!size.ok()) return size.status();
  std::string start(std::min(*size, kMeshStartSize), '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  Content content;
  content.space_mark = std::string(FindSpaceMark(start));
  for (const MeshFormat& format : kFormats) {
    if (content.format == nullptr && format.recognises(start, *size)) content.format = &format;
  }
  return content;
}

}  // namespace

const MeshFormat* FindMeshFormat(const std::string& path) {
  const std::string ending = EndingOf(path);
  if (ending.empty() || path.rfind("/dev/", 0) == 0) return &kFormats[0];
  for (const MeshFormat& format : kFormats) {
    if (ending == format.ending) return &format;
  }
  return nullptr;
}

Status CheckMeshEnding(const std::string& path) {
  if (FindMeshFormat(path) != nullptr) return Status::Ok();
  std::string endings;
  for (const MeshFormat& format : kFormats) endings += std::string(" ") + format.ending;
  return Status::Error(path + ": no format of meshes has the ending " + EndingOf(path) +
                       ", expected one of" + endings);
}

StatusOr<PlyDocument> ReadMesh(const std::string& path) {
  const StatusOr<Content> content = Recognise(path);
  if (!content.ok()) return content.status();
  const MeshFormat* const by_ending = FindMeshFormat(path);
  const MeshFormat* const format = content->format != nullptr ? content->format
                                   : by_ending != nullptr     ? by_ending
                                                              : &kFormats[0];
  StatusOr<PlyDocument> document = format->read(path);
  const bool is_mismatch = by_ending != nullptr && !EndingOf(path).empty() && format != by_ending;
  if (document.ok() && SpaceMarkOf(*document) != content->space_mark) {
    document->comments.push_back(content->space_mark);
  }
  if (document.ok() && is_mismatch) {
    document->warnings.push_back("the file is named as " + std::string(by_ending->name) +
                                 " and holds " + format->name + ", as which it was read");
  }
  return document;
}

Status WriteMesh(const std::string& path, const PlyDocument& document) {
  if (Status status = CheckMeshEnding(path); !status.ok()) return status;
  return FindMeshFormat(path)->write(path, document);
}

}  // namespace ceres_ed
