// The formats of meshes and points, which are chosen by the ending of a file's name.
#ifndef CERES_ED_IO_MESH_MESH_FORMAT_H_
#define CERES_ED_IO_MESH_MESH_FORMAT_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// A row of the table in mesh_format.cc. To add a format, write a file with the two functions and
// add a row.
struct MeshFormat {
  // The ending of a file's name, in lower case.
  const char* ending;
  StatusOr<PlyDocument> (*read)(const std::string& path);
  // Writes everything that the document has, or returns an error that names what the format can't
  // represent.
  Status (*write)(const std::string& path, const PlyDocument& document);
};

// Returns the format for the ending of `path`, in lower or upper case; PLY if no format has that
// ending.
const MeshFormat& MeshFormatOf(const std::string& path);

// Reads a file in the format of its ending. Errors are as those of the format's reader.
StatusOr<PlyDocument> ReadMesh(const std::string& path);

// Writes `document` to `path` in the format of its ending. After an error the old file is
// unchanged.
Status WriteMesh(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_FORMAT_H_
