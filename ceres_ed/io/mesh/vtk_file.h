// VTK's files of surfaces: the legacy format (.vtk) and that in XML (.vtp). They are read and
// written by the module for VTK.
#ifndef CERES_ED_IO_MESH_VTK_FILE_H_
#define CERES_ED_IO_MESH_VTK_FILE_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// Reads the poly data of a file of either format. Points keep their type and order; polygons, and
// then strips as triangles, become faces, and lines become edges. Point data and cell data become
// properties of vertices and faces: an array of several components NAME becomes NAME_0, NAME_1,
// ...; normals become nx ny nz, and an array of three or four unsigned bytes becomes red green blue
// alpha. Errors name the file: it is damaged, it holds no poly data, or the module is missing (and
// how to get it).
StatusOr<PlyDocument> ReadVtk(const std::string& path);

// Writes a binary file of the format of the ending: legacy for .vtk, XML for .vtp. Columns become
// arrays of the same types; what ReadVtk() made of arrays becomes these again.
Status WriteVtk(const std::string& path, const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_VTK_FILE_H_
