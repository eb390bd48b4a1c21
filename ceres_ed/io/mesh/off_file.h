// OFF, the object file format of Geomview.
#ifndef CERES_ED_IO_MESH_OFF_FILE_H_
#define CERES_ED_IO_MESH_OFF_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads an ascii file OFF, COFF, NOFF, CNOFF or STOFF in any order of these letters: vertices in
// double, with normals, colours and texture coordinates (s t) where they are there, and polygons
// with colours. Colours are bytes or in [0, 1]. Errors name the line.
StatusOr<PlyDocument> ReadOff(const std::string& path);

// Writes vertices with normals and colours, and polygons with colours. Numbers have the fewest
// digits from which the same double is read back.
Status WriteOff(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_OFF_FILE_H_
