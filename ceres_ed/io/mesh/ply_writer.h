// Writes PLY files.
#ifndef CERES_ED_IO_MESH_PLY_WRITER_H_
#define CERES_ED_IO_MESH_PLY_WRITER_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Writes `document` to `path` in its format, with elements and properties in their order. The error
// gives the system's reason, and the old file is then unchanged. Ascii numbers are the shortest
// from which the same float or double is read back. Fails a CHECK if a value does not fit the type
// of its property, or if a property has another number of rows than its element.
Status WritePly(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_WRITER_H_
