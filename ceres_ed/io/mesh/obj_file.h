// OBJ, the text format of Wavefront.
#ifndef CERES_ED_IO_MESH_OBJ_FILE_H_
#define CERES_ED_IO_MESH_OBJ_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads `path`: vertices in the order of the file, in double, with colours behind the coordinates
// (`v x y z r g b`); polygons as they are; segments of `l` as element 'edge' (vertex1 vertex2);
// texture coordinates as element 'texture_vertex' (u v w) with a list texture_indices at each face;
// normals if all corners at a vertex name the same one; o, g, s and usemtl as groups
// (face_groups.h); mtllib as comments. Warnings of the document count the lines that are left out.
// Errors name the line.
StatusOr<PlyDocument> ReadObj(const std::string& path);

// Writes what ReadObj() reads. Numbers have the fewest digits from which the same double is read
// back.
Status WriteObj(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_OBJ_FILE_H_
