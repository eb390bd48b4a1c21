// PLY files, read in full.
#ifndef CERES_ED_IO_MESH_PLY_READER_H_
#define CERES_ED_IO_MESH_PLY_READER_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Returns the whole file: ascii or binary of either byte order, lines that end in LF, CR LF or CR
// alone, any elements, any properties. Rows count from 0, as face indices do.
// Errors name the file, the line or the row and what was expected: no such file, not a PLY, a bad
// header, a number that is none or does not fit its type, a negative list length, or fewer rows
// than promised. A promised count costs no memory that the file does not cover. Bytes behind the
// last row are ignored.
StatusOr<PlyDocument> ReadPly(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_PLY_READER_H_
