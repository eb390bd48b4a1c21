// PCD, the format of the Point Cloud Library. It is read and written by the module for PCL.
#ifndef CERES_ED_IO_MESH_PCD_FILE_H_
#define CERES_ED_IO_MESH_PCD_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads the points of the PCD file `path` as element 'vertex'. Each field becomes a property (`rgb`
// and `rgba` become red green blue and alpha), and a field of several numbers becomes a list.
// obj_info lines keep the viewpoint and the size of a cloud in rows and columns. Errors name the
// file: it can't be read, it is truncated, or the module is missing (and how to get it).
StatusOr<PlyDocument> ReadPcd(const std::string& path);

// Writes the vertices of `document` to `path` as a binary PCD. It is an error if the document has
// faces or other elements, which a PCD can't represent. Other errors are as those of ReadPcd().
Status WritePcd(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PCD_FILE_H_
