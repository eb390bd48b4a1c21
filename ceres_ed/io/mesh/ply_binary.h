// The body of a binary PLY.
#ifndef CERES_ED_IO_MESH_PLY_BINARY_H_
#define CERES_ED_IO_MESH_PLY_BINARY_H_

#include <ceres_ed/io/mesh/ply_header.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <string>

namespace ceres_ed {

// Returns ok and fills the values of `header->document` from the file `path` of `file_size` bytes,
// whose header that is. Errors name the row in which the file ends, or the row of a negative list
// length.
Status ReadPlyBinaryBody(const std::string& path, std::size_t file_size, PlyHeader* header);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_BINARY_H_
