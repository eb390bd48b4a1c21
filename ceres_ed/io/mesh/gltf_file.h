// GLB, the binary file of glTF 2. It is read and written by the module for glTF.
#ifndef CERES_ED_IO_MESH_GLTF_FILE_H_
#define CERES_ED_IO_MESH_GLTF_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads the triangles and points of all meshes in the scene, placed by the transforms of their
// nodes, in the order of the scene. Vertices keep their order; coordinates are floats. NORMAL
// becomes nx ny nz, COLOR_0 becomes red green blue alpha, and scalar attributes _NAME become
// properties name. Warnings of the document count what is left out. Errors name the file: it is
// damaged, it is compressed, or the module is missing (and how to get it).
StatusOr<PlyDocument> ReadGlb(const std::string& path);

// Writes one mesh with all vertices; polygons are cut into triangles. Scalar properties become
// attributes _NAME: bytes as they are, other types as floats.
Status WriteGlb(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_GLTF_FILE_H_
