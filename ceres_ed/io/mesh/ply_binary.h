// The body of a binary PLY.
#ifndef CERES_ED_IO_MESH_PLY_BINARY_H_
#define CERES_ED_IO_MESH_PLY_BINARY_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <string_view>

namespace ceres_ed {

// Reads the values of `document`, whose header is read already, from `body`: the bytes of the file
// `path` after its header, in either byte order. Errors name the row in which the file ends, or the
// row of a negative list length. Memory is reserved only for values that `body` contains, whatever
// the header and the lengths of lists say.
Status ReadPlyBinaryBody(const std::string& path, std::string_view body, PlyDocument* document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_BINARY_H_
