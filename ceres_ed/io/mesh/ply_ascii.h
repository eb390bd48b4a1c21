// The body of an ascii PLY.
#ifndef CERES_ED_IO_MESH_PLY_ASCII_H_
#define CERES_ED_IO_MESH_PLY_ASCII_H_

#include <ceres_ed/io/mesh/ply_header.h>
#include <ceres_ed/util/status.h>

#include <optional>
#include <string>
#include <string_view>

namespace ceres_ed {

// Returns the value of `word` as `type` keeps it, or nothing where it is no number or does not fit.
std::optional<double> ParsePlyNumber(std::string_view word, PlyType type);

// Returns ok and fills the values of `header->document` from `body`: the text of the file `path`
// behind that header. One row a line, blank lines ignored; errors name the line. A number that its
// type cannot hold, such as `300` for a uchar, is an error.
Status ReadPlyAsciiBody(const std::string& path, std::string_view body, PlyHeader* header);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_ASCII_H_
