#include "ceres_ed/vtk/document_from_vtk.h"

#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/vtk/array_line.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace ceres_ed {
namespace {

// The type of a column with the values of `array`; `is_exact` is false where 64 bits are too many.
PlyType TypeOf(vtkDataArray* array) {
  switch (array->GetDataType()) {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return PlyType::kInt8;
    case VTK_BIT:
    case VTK_UNSIGNED_CHAR:
      return PlyType::kUint8;
    case VTK_SHORT:
      return PlyType::kInt16;
    case VTK_UNSIGNED_SHORT:
      return PlyType::kUint16;
    case VTK_INT:
      return PlyType::kInt32;
    case VTK_UNSIGNED_INT:
      return PlyType::kUint32;
    case VTK_FLOAT:
      return PlyType::kFloat32;
    case VTK_DOUBLE:
      return PlyType::kFloat64;
    default:
      break;
  }
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) {
    const double value = array->GetComponent(i / array->GetNumberOfComponents(),
                                             static_cast<int>(i % array->GetNumberOfComponents()));
    const bool fits = value >= std::numeric_limits<std::int32_t>::lowest() &&
                      value <= std::numeric_limits<std::int32_t>::max();
    if (!fits) return PlyType::kFloat64;
  }
  return PlyType::kInt32;
}

// Returns a name without blanks and control characters.
std::string UsableName(const std::string& name) {
  std::string usable;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    usable += code > ' ' && code != 0x7f ? c : '_';
  }
  return usable.empty() ? "data" : usable;
}

const char* RoleOf(vtkDataSetAttributes* data, int array) {
  switch (data->IsArrayAnAttribute(array)) {
    case vtkDataSetAttributes::SCALARS:
      return "scalars";
    case vtkDataSetAttributes::VECTORS:
      return "vectors";
    case vtkDataSetAttributes::NORMALS:
      return "normals";
    case vtkDataSetAttributes::TCOORDS:
      return "tcoords";
    case vtkDataSetAttributes::TENSORS:
      return "tensors";
    default:
      return "none";
  }
}

class DocumentBuilder {
 public:
  explicit DocumentBuilder(vtkPolyData* surface) : surface_(surface) {}

  PlyDocument Build() {
    AddVertices();
    AddFaces();
    AddEdges();
    const vtkIdType points = surface_->GetVerts()->GetNumberOfCells();
    if (points > 0 && !rows_of_faces_.empty()) {
      Warn(Counted(static_cast<std::size_t>(points), "cell") + " of points left out");
    }
    return std::move(document_);
  }

 private:
  void AddVertices() {
    PlyElement vertices;
    vertices.name = "vertex";
    vertices.count = static_cast<std::size_t>(surface_->GetNumberOfPoints());
    std::vector<vtkIdType> rows(vertices.count);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<vtkIdType>(i);
    if (vertices.count > 0) {
      AddArray(surface_->GetPoints()->GetData(), {"x", "y", "z"}, rows, &vertices);
    } else {
      for (const char* const name : {"x", "y", "z"}) {
        vertices.properties.push_back(MakePlyScalar(name, PlyType::kFloat32));
      }
    }
    AddData(surface_->GetPointData(), surface_->GetNumberOfPoints(), rows, &vertices);
    document_.elements.push_back(std::move(vertices));
  }

  void AddFaces() {
    std::vector<double> corners;
    std::vector<std::uint32_t> sizes;
    // Cells of points and lines come first in the data of cells.
    vtkIdType cell =
        surface_->GetVerts()->GetNumberOfCells() + surface_->GetLines()->GetNumberOfCells();
    const vtkNew<vtkIdList> points;
    vtkCellArray* const polygons = surface_->GetPolys();
    for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i, ++cell) {
      polygons->GetCellAtId(i, points);
      for (vtkIdType c = 0; c < points->GetNumberOfIds(); ++c) {
        corners.push_back(static_cast<double>(points->GetId(c)));
      }
      sizes.push_back(static_cast<std::uint32_t>(points->GetNumberOfIds()));
      rows_of_faces_.push_back(cell);
    }
    vtkCellArray* const strips = surface_->GetStrips();
    for (vtkIdType i = 0; i < strips->GetNumberOfCells(); ++i, ++cell) {
      strips->GetCellAtId(i, points);
      for (vtkIdType c = 2; c < points->GetNumberOfIds(); ++c) {
        // Every second triangle of a strip is wound the other way round.
        const bool is_odd = c % 2 == 1;
        for (const vtkIdType corner : {c - 2, is_odd ? c : c - 1, is_odd ? c - 1 : c}) {
          corners.push_back(static_cast<double>(points->GetId(corner)));
        }
        sizes.push_back(3);
        rows_of_faces_.push_back(cell);
      }
    }
    if (sizes.empty()) return;
    AppendFaces(std::move(corners), std::move(sizes), &document_);
    AddData(surface_->GetCellData(),
            surface_->GetNumberOfCells(),
            rows_of_faces_,
            &document_.elements.back());
  }

  void AddEdges() {
    vtkCellArray* const lines = surface_->GetLines();
    if (lines->GetNumberOfCells() == 0) return;
    PlyElement edges;
    edges.name = "edge";
    edges.properties = {MakePlyScalar("vertex1", PlyType::kInt32),
                        MakePlyScalar("vertex2", PlyType::kInt32)};
    const vtkNew<vtkIdList> points;
    for (vtkIdType i = 0; i < lines->GetNumberOfCells(); ++i) {
      lines->GetCellAtId(i, points);
      for (vtkIdType c = 1; c < points->GetNumberOfIds(); ++c) {
        edges.properties[0].values.push_back(static_cast<double>(points->GetId(c - 1)));
        edges.properties[1].values.push_back(static_cast<double>(points->GetId(c)));
      }
    }
    edges.count = edges.properties[0].values.size();
    document_.elements.push_back(std::move(edges));
  }

  void AddData(vtkDataSetAttributes* data,
               vtkIdType size,
               const std::vector<vtkIdType>& rows,
               PlyElement* element) {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
      vtkAbstractArray* const any = data->GetAbstractArray(i);
      vtkDataArray* const array = vtkDataArray::SafeDownCast(any);
      const std::string name = any->GetName() == nullptr ? "" : any->GetName();
      if (array == nullptr || array->GetNumberOfTuples() != size ||
          array->GetNumberOfComponents() < 1) {
        Warn("the array '" + UsableName(name) + "' left out: it has no numbers, or not one row " +
             (element->name == "vertex" ? "a point" : "a cell"));
        continue;
      }
      ArrayLine line;
      line.element = element->name;
      line.components = static_cast<std::size_t>(array->GetNumberOfComponents());
      line.role = RoleOf(data, i);
      line.name = name.empty() ? "data" : name;
      const bool is_vector = line.components == 3;
      const bool is_normals = is_vector && element->Find("nx") == nullptr &&
                              (line.role == "normals" || name == "Normals" || name == "normals");
      const bool is_colors = (is_vector || line.components == 4) &&
                             array->GetDataType() == VTK_UNSIGNED_CHAR &&
                             element->Find("red") == nullptr;
      std::string base = UsableName(name);
      // Two arrays may have one name, or that of a coordinate.
      const auto is_taken = [&](const std::string& candidate) {
        for (const std::string& column :
             ColumnNames(candidate, line.components, is_normals, is_colors)) {
          if (element->Find(column) != nullptr) return true;
        }
        return false;
      };
      while (!is_normals && !is_colors && is_taken(base)) base += '_';
      const std::vector<std::string> names =
          ColumnNames(base, line.components, is_normals, is_colors);
      line.column = names.front();
      AddArray(array, names, rows, element);
      document_.obj_info.push_back(line.Format());
    }
  }

  static void AddArray(vtkDataArray* array,
                       const std::vector<std::string>& names,
                       const std::vector<vtkIdType>& rows,
                       PlyElement* element) {
    const PlyType type = TypeOf(array);
    for (std::size_t i = 0; i < names.size(); ++i) {
      PlyProperty column = MakePlyScalar(names[i], type);
      column.values.reserve(rows.size());
      for (const vtkIdType row : rows) {
        column.values.push_back(array->GetComponent(row, static_cast<int>(i)));
      }
      element->properties.push_back(std::move(column));
    }
  }

  void Warn(const std::string& what) { document_.warnings.push_back(what); }

  vtkPolyData* surface_;
  PlyDocument document_;
  // The row in the data of cells from which each face has its properties.
  std::vector<vtkIdType> rows_of_faces_;
};

}  // namespace

PlyDocument DocumentFromVtk(vtkPolyData* surface) { return DocumentBuilder(surface).Build(); }

}  // namespace ceres_ed
