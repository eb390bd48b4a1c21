// Reads lists of vertices that a user writes by hand: landmarks and fixed vertices.
#ifndef CERES_ED_IO_POINT_LIST_IO_H_
#define CERES_ED_IO_POINT_LIST_IO_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// Reads the rows `source_index,x,y,z` of a CSV file, in the order of the file; at least one. The
// header row is optional. Text after # and blank lines are ignored; lines end in LF or CR LF. A row
// that is repeated exactly is used once. Errors name file, line, value and what was expected. It is
// an error if a value is not a number or not finite, an index is outside [0, num_vertices), or a
// vertex has two positions.
StatusOr<std::vector<Landmark>> ReadLandmarks(const std::string& path, int num_vertices);

// Reads the vertex indices of a text file, and returns them ascending, each of them once. They are
// whole numbers separated by blanks, commas or line ends; text after # is ignored. An empty file
// gives an empty list. Errors name file, line, value and what was expected.
StatusOr<std::vector<int>> ReadVertexList(const std::string& path, int num_vertices);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_POINT_LIST_IO_H_
