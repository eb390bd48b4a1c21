// Lists of vertices that a user writes by hand: landmarks and fixed vertices.
#ifndef CERES_ED_IO_POINT_LIST_IO_H_
#define CERES_ED_IO_POINT_LIST_IO_H_

#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Where a vertex of the source is to go.
struct Landmark {
  // Row in the source file.
  int index = -1;
  // In the frame and unit of the target.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// Returns the rows `source_index,x,y,z` of a CSV file in the order of the file, at least one. The
// header row is optional; text behind # and blank lines are ignored; LF or CR LF. A row that says
// the same twice is taken once. Errors name file, line, value and what was expected: no number, not
// finite, an index outside [0, num_vertices), two positions for one vertex.
StatusOr<std::vector<Landmark>> ReadLandmarks(const std::string& path, int num_vertices);

// Returns the vertex indices of a text file, ascending and each once: whole numbers set apart by
// blanks, commas or line ends, text behind # ignored. An empty file is an empty list. Errors name
// file, line, value and what was expected.
StatusOr<std::vector<int>> ReadVertexList(const std::string& path, int num_vertices);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_POINT_LIST_IO_H_
