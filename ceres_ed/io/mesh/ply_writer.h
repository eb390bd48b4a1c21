// PLY files, written.
#ifndef CERES_ED_IO_MESH_PLY_WRITER_H_
#define CERES_ED_IO_MESH_PLY_WRITER_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns ok when `path` holds `document` in the format that it names, elements and properties in
// order; else an error with the system's reason, and the old file is as it was. Ascii numbers are
// the shortest that read back to the same float or double. Every value must fit its property's
// type, and every property must have as many rows as its element: a CHECK.
Status WritePly(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_WRITER_H_
