// Makes a document of a surface of VTK.
#ifndef CERES_ED_VTK_DOCUMENT_FROM_VTK_H_
#define CERES_ED_VTK_DOCUMENT_FROM_VTK_H_

#include <ceres_ed/io/mesh/ply_document.h>

class vtkPolyData;  // NOLINT(cppcoreguidelines-virtual-class-destructor): it is VTK's

namespace ceres_ed {

// Returns the points, polygons, strips (as triangles) and lines (as edges) of `surface`, with point
// data and cell data as columns (array_line.h). Integers of 64 bits become int or, where one does
// not fit, double. Warnings of the document count what was left out.
PlyDocument DocumentFromVtk(vtkPolyData* surface);

}  // namespace ceres_ed

#endif  // CERES_ED_VTK_DOCUMENT_FROM_VTK_H_
