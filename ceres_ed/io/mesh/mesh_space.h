// In which anatomical space the coordinates of a mesh are, where its file says so.
#ifndef CERES_ED_IO_MESH_MESH_SPACE_H_
#define CERES_ED_IO_MESH_MESH_SPACE_H_

#include <ceres_ed/io/landmarks/landmark_file.h>
#include <ceres_ed/io/mesh/ply_document.h>

#include <string_view>

namespace ceres_ed {

// Returns "SPACE=LPS" or "SPACE=RAS" if `text` has one of them, otherwise an empty text.
std::string_view FindSpaceMark(std::string_view text);

// Returns the mark in the comments of a document, or an empty text. 3D Slicer writes it into the
// comment or header of PLY, STL, OBJ and VTK files, and into the field data of VTP files.
// ReadMesh() adds it as a comment where a format has it at another place, and writers of such
// formats write it there again.
std::string_view SpaceMarkOf(const PlyDocument& document);

// Returns the space that the mark names.
AnatomicalSpace SpaceOfDocument(const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_MESH_SPACE_H_
