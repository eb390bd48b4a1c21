// The body of an ascii PLY.
#ifndef CERES_ED_IO_MESH_PLY_ASCII_H_
#define CERES_ED_IO_MESH_PLY_ASCII_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <string_view>

namespace ceres_ed {

// Returns ok and fills the values of `document`, whose header is there already, from `body`, which
// starts behind line `lines_before` of `path`. One row a line, blank lines ignored; errors name the
// line. Not PCL's parser: that one reads the integers `1x` and `200.0` as 0 and the uchar `300` as
// 44 without a word, and takes seven times as long.
Status ReadPlyAsciiBody(const std::string& path,
                        std::string_view body,
                        int lines_before,
                        PlyDocument* document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_ASCII_H_
