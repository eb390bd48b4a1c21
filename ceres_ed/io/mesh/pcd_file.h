// PCD, the format of the Point Cloud Library: read and written by the module for PCL.
#ifndef CERES_ED_IO_MESH_PCD_FILE_H_
#define CERES_ED_IO_MESH_PCD_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns the points of the PCD file `path` as element 'vertex': each field a property (`rgb` and
// `rgba` as red green blue and alpha), a field of several numbers a list. obj_info lines keep the
// size of a cloud in rows and columns, and the viewpoint. Errors name the file: it cannot be read,
// it is truncated, or the module is not there, and how to get it.
StatusOr<PlyDocument> ReadPcd(const std::string& path);

// Returns ok when `path` holds the vertices of `document` as a binary PCD; an error where the
// document has faces or other elements, which a PCD cannot hold, and as of ReadPcd.
Status WritePcd(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PCD_FILE_H_
