// Reads PLY files completely.
#ifndef CERES_ED_IO_MESH_PLY_READER_H_
#define CERES_ED_IO_MESH_PLY_READER_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads the whole file: ascii or binary of either byte order, with lines that end in LF, CR LF or
// CR alone, and with any elements and properties. Rows are counted from 0, as face indices are.
//
// Errors name the file, the line or the row and what was expected. It is an error if there is no
// such file, it is not a PLY, its header is not valid, a number can't be read or does not fit its
// type, a list has a negative length, or there are fewer rows than the header says. Memory is used
// only for what the file contains, whatever counts it gives. Bytes after the last row are ignored.
StatusOr<PlyDocument> ReadPly(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_READER_H_
