// The formats of meshes and points, chosen by the ending of a file's name.
#ifndef CERES_ED_IO_MESH_MESH_FORMAT_H_
#define CERES_ED_IO_MESH_MESH_FORMAT_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// A row of the table in mesh_format.cc: a new format is a file with the two functions, and a row.
struct MeshFormat {
  // Ending of a file's name, in small letters.
  const char* ending;
  StatusOr<PlyDocument> (*read)(const std::string& path);
  // Keeps all that the document has, or returns an error that names what the format cannot hold.
  Status (*write)(const std::string& path, const PlyDocument& document);
};

// Returns the format of `path`: by its ending, in letters of either case; PLY where no format has
// that ending.
const MeshFormat& MeshFormatOf(const std::string& path);

// Returns the file as a document, read as its ending says; errors as of the format's reader.
StatusOr<PlyDocument> ReadMesh(const std::string& path);

// Returns ok when `path` holds `document` in the format that its ending names; else an error, and
// the old file is as it was.
Status WriteMesh(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_FORMAT_H_
