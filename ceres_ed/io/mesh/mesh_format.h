// The formats of meshes and points. A file is read as what it is by its content, and written in the
// format of the ending of its name.
#ifndef CERES_ED_IO_MESH_MESH_FORMAT_H_
#define CERES_ED_IO_MESH_MESH_FORMAT_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ceres_ed {

// What a format can represent. Lists of names are separated by blanks; "*" stands for all names of
// scalars.
struct MeshAbilities {
  // Coordinates in double; otherwise they are rounded to floats.
  bool doubles = false;
  // Faces of more than three corners; otherwise they are cut into triangles.
  bool polygons = false;
  // Vertices as a list, which faces refer to; otherwise each triangle has its own corners.
  bool has_vertex_list = true;
  // The properties of vertices and faces that survive, beside the coordinates and the corners.
  std::string_view vertex_data;
  std::string_view face_data;
  // Elements beside vertices and faces that survive.
  std::string_view elements;
  // The properties of faces that survive in an ascii file, if these are others.
  std::string_view ascii_face_data;
  // Faces at all; otherwise a mesh is refused.
  bool faces = true;
};

// A row of the table in mesh_format.cc. To add a format, write a file with the functions and add a
// row.
struct MeshFormat {
  // The ending of a file's name, in lower case.
  const char* ending;
  // The name of the format in messages.
  const char* name;
  // Whether a file is of this format, by its first bytes (at most kMeshStartSize) and its size.
  bool (*recognises)(std::string_view start, std::size_t size);
  StatusOr<PlyDocument> (*read)(const std::string& path);
  // Writes everything that the format can represent.
  Status (*write)(const std::string& path, const PlyDocument& document);
  MeshAbilities abilities;
};

// The number of bytes from which formats are recognised.
inline constexpr std::size_t kMeshStartSize = 4096;

// Returns the format for the ending of `path`, in lower or upper case, or null if no format has
// that ending. Names without an ending and devices (/dev/...) count as PLY.
const MeshFormat* FindMeshFormat(const std::string& path);

// Returns an error that lists the endings if no format has that of `path`, a file to write.
Status CheckMeshEnding(const std::string& path);

// Reads a file as what it is by its content. If that is not what its ending says, a warning of the
// document says so; a file that no format recognises is read by its ending, and as PLY if that is
// unknown. Errors are as those of the format's reader.
StatusOr<PlyDocument> ReadMesh(const std::string& path);

// Writes `document` to `path` in the format of its ending; an unknown one is an error. After an
// error the old file is unchanged. What the format can't represent is lost: LossesOf() tells.
Status WriteMesh(const std::string& path, const PlyDocument& document);

// Returns an error if a file of that name can't hold the document at all: points as triangles
// alone, or a mesh as points alone. It is what WriteMesh() would say after a long computation.
Status CheckHolds(const std::string& path, const PlyDocument& document);

// Returns a sentence, which begins with `path`, for each kind of thing of `document` that a file of
// that name can't represent: doubles, polygons, the order of vertices, properties, elements.
std::vector<std::string> LossesOf(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_FORMAT_H_
