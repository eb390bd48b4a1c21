// Makes a surface of VTK of a document.
#ifndef CERES_ED_VTK_VTK_FROM_DOCUMENT_H_
#define CERES_ED_VTK_VTK_FROM_DOCUMENT_H_

#include <ceres_ed/io/mesh/ply_document.h>
#include <ceres_ed/util/status.h>

#include <string>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

namespace ceres_ed {

// Returns the vertices, faces and edges of `document`, and their scalar columns as arrays: those
// that DocumentFromVtk() named are as they were; of the others nx ny nz become `Normals`, and red
// green blue (alpha) of bytes become `RGB` or `RGBA`. Without faces, each point is a cell, so that
// viewers show it. Errors begin with `path`.
StatusOr<vtkSmartPointer<vtkPolyData>> VtkFromDocument(const std::string& path,
                                                       const PlyDocument& document);

}  // namespace ceres_ed

#endif  // CERES_ED_VTK_VTK_FROM_DOCUMENT_H_
