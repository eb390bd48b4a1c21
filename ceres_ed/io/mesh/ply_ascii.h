// The body of an ascii PLY.
#ifndef CERES_ED_IO_MESH_PLY_ASCII_H_
#define CERES_ED_IO_MESH_PLY_ASCII_H_

#include <ceres_ed/io/mesh/ply_header.h>
#include <ceres_ed/util/status.h>

#include <optional>
#include <string>
#include <string_view>

namespace ceres_ed {

// Returns the value of `word` in the precision of `type`, or nothing if it is not a number or does
// not fit.
std::optional<double> ParsePlyNumber(std::string_view word, PlyType type);

// Reads the values of `header->document` from `body`, which is the text of the file `path` after
// that header. Each line has one row; blank lines are ignored. Errors name the line. It is an error
// if a number does not fit its type, for example `300` for a uchar.
Status ReadPlyAsciiBody(const std::string& path, std::string_view body, PlyHeader* header);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_ASCII_H_
