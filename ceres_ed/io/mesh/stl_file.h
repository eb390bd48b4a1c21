// STL, the triangles of stereolithography.
#ifndef CERES_ED_IO_MESH_STL_FILE_H_
#define CERES_ED_IO_MESH_STL_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace ceres_ed {

// Returns whether `size` is that of a binary STL with the number of triangles that its first 84
// bytes give. Many binary files begin with the word of ascii files, `solid`.
bool HasSizeOfBinaryStl(std::string_view start, std::size_t size);

// Reads a binary or ascii file. It has three corners for each triangle; corners at the same place
// (equal in all bits) become one vertex, in the order in which they come, so that the surface is
// connected. Triangles keep their order and their corners. Coordinates are floats. The 16 bits of a
// triangle become an ushort property `attribute` of the faces unless all are zero; the names of
// ascii solids become groups (face_groups.h). Normals are left out: they follow from the corners.
StatusOr<PlyDocument> ReadStl(const std::string& path);

// Writes the triangles of a document, as ascii if the document came from an ascii file and else
// binary. Polygons are cut. It is an error if there are no faces.
Status WriteStl(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_STL_FILE_H_
