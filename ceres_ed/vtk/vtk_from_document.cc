#include "ceres_ed/vtk/vtk_from_document.h"

#include <ceres_ed/io/mesh/mesh_view.h>
#include <ceres_ed/vtk/array_line.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace ceres_ed {
namespace {

int VtkTypeOf(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
      return VTK_SIGNED_CHAR;
    case PlyType::kUint8:
      return VTK_UNSIGNED_CHAR;
    case PlyType::kInt16:
      return VTK_SHORT;
    case PlyType::kUint16:
      return VTK_UNSIGNED_SHORT;
    case PlyType::kInt32:
      return VTK_INT;
    case PlyType::kUint32:
      return VTK_UNSIGNED_INT;
    case PlyType::kFloat32:
      return VTK_FLOAT;
    case PlyType::kFloat64:
      break;
  }
  return VTK_DOUBLE;
}

using Columns = std::vector<const PlyProperty*>;

// Returns the columns of these names that are scalars of one type, or nothing.
Columns FindAll(const PlyElement& element, const std::vector<std::string>& names) {
  Columns columns;
  for (const std::string& name : names) {
    const PlyProperty* const column = element.Find(name);
    if (column == nullptr || column->is_list) return {};
    if (!columns.empty() && column->type != columns.front()->type) return {};
    columns.push_back(column);
  }
  return columns;
}

// An array with a row for each of `before` cells without data and for each row of the columns.
vtkSmartPointer<vtkDataArray> MakeArray(const std::string& name,
                                        const Columns& columns,
                                        std::size_t before) {
  const PlyType type = columns.front()->type;
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VtkTypeOf(type)));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(columns.size()));
  const std::size_t count = columns.front()->values.size();
  const std::size_t num_rows = before + count;
  array->SetNumberOfTuples(static_cast<vtkIdType>(num_rows));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t row = 0; row < num_rows; ++row) {
      array->SetComponent(static_cast<vtkIdType>(row),
                          static_cast<int>(i),
                          row < before ? 0.0 : columns[i]->values[row - before]);
    }
  }
  return array;
}

void SetRole(const std::string& role, const char* name, vtkDataSetAttributes* data) {
  if (role == "scalars") data->SetActiveScalars(name);
  if (role == "vectors") data->SetActiveVectors(name);
  if (role == "normals") data->SetActiveNormals(name);
  if (role == "tcoords") data->SetActiveTCoords(name);
  if (role == "tensors") data->SetActiveTensors(name);
}

// The arrays to write for an element: those that were read, then the usual ones.
std::vector<ArrayLine> LinesOf(const PlyDocument& document, const PlyElement& element) {
  std::vector<ArrayLine> lines;
  for (const std::string& info : document.obj_info) {
    const std::optional<ArrayLine> line = ArrayLine::Parse(info);
    const bool fits = line.has_value() && line->element == element.name &&
                      line->components <= element.properties.size();
    if (fits) lines.push_back(*line);
  }
  for (const char* const first : {"nx", "normal_x"}) {
    lines.push_back({element.name, 3, "normals", first, "Normals"});
  }
  const bool has_alpha = element.Find("alpha") != nullptr;
  if (has_alpha) lines.push_back({element.name, 4, "scalars", "red", "RGBA"});
  lines.push_back({element.name, 3, "scalars", "red", "RGB"});
  return lines;
}

// Returns the columns of an array; nothing if they are no longer there.
Columns ColumnsOf(const ArrayLine& line, const PlyElement& element) {
  const bool is_colors = line.column == "red";
  if (line.column == "normal_x") return FindAll(element, {"normal_x", "normal_y", "normal_z"});
  if (line.components > 1 && !is_colors && line.column != "nx") {
    const std::size_t number = line.column.rfind("_0");
    if (number == std::string::npos) return {};
    return FindAll(element,
                   ColumnNames(line.column.substr(0, number), line.components, false, false));
  }
  return FindAll(element,
                 ColumnNames(line.column, line.components, line.column == "nx", is_colors));
}

void AddData(const PlyDocument& document,
             const PlyElement& element,
             std::size_t before,
             std::set<const PlyProperty*> written,
             vtkDataSetAttributes* data) {
  const auto add = [&](const std::string& name, const std::string& role, const Columns& columns) {
    data->AddArray(MakeArray(name, columns, before));
    SetRole(role, name.c_str(), data);
    written.insert(columns.begin(), columns.end());
  };
  for (const ArrayLine& line : LinesOf(document, element)) {
    const Columns columns = ColumnsOf(line, element);
    const bool is_free = std::none_of(
        columns.begin(), columns.end(), [&](const PlyProperty* c) { return written.count(c) > 0; });
    if (columns.empty() || !is_free || data->HasArray(line.name.c_str()) != 0) continue;
    // Colours are bytes in VTK.
    if (line.column == "red" && columns.front()->type != PlyType::kUint8) continue;
    add(line.name, line.role, columns);
  }
  for (const PlyProperty& column : element.properties) {
    if (!column.is_list && written.count(&column) == 0) add(column.name, "none", {&column});
  }
}

std::size_t AddLines(const PlyDocument& document, std::size_t num_points, vtkPolyData* surface) {
  const PlyElement* const edges = document.Find("edge");
  if (edges == nullptr) return 0;
  const Columns ends = FindAll(*edges, {"vertex1", "vertex2"});
  if (ends.empty() || IsFloatingPlyType(ends[0]->type)) return 0;
  const vtkNew<vtkCellArray> lines;
  for (std::size_t row = 0; row < edges->count; ++row) {
    const double from = ends[0]->values[row];
    const double to = ends[1]->values[row];
    const auto count = static_cast<double>(num_points);
    if (from < 0.0 || to < 0.0 || from >= count || to >= count) continue;
    lines->InsertNextCell({static_cast<vtkIdType>(from), static_cast<vtkIdType>(to)});
  }
  surface->SetLines(lines);
  return static_cast<std::size_t>(lines->GetNumberOfCells());
}

}  // namespace

StatusOr<vtkSmartPointer<vtkPolyData>> VtkFromDocument(const std::string& path,
                                                       const PlyDocument& document) {
  const StatusOr<MeshView> view = MeshView::Of(path, document);
  if (!view.ok()) return view.status();
  const PlyElement& vertices = view->vertices();
  const auto surface = vtkSmartPointer<vtkPolyData>::New();
  Columns positions = FindAll(vertices, {"x", "y", "z"});
  std::vector<PlyProperty> as_doubles;
  if (positions.empty()) {
    // Their types differ.
    for (const char* const name : {"x", "y", "z"}) {
      as_doubles.push_back(MakePlyScalar(name, PlyType::kFloat64, vertices.Find(name)->values));
    }
    for (const PlyProperty& column : as_doubles) positions.push_back(&column);
  }
  const vtkNew<vtkPoints> points;
  points->SetData(MakeArray("Points", positions, 0));
  surface->SetPoints(points);
  const std::set<const PlyProperty*> coordinates = {
      vertices.Find("x"), vertices.Find("y"), vertices.Find("z")};
  AddData(document, vertices, 0, coordinates, surface->GetPointData());
  const std::size_t num_lines = AddLines(document, vertices.count, surface);
  if (view->NumFaces() == 0 && num_lines == 0) {
    const vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < vertices.count; ++i) {
      cells->InsertNextCell({static_cast<vtkIdType>(i)});
    }
    surface->SetVerts(cells);
  }
  if (view->NumFaces() == 0) return surface;
  const vtkNew<vtkCellArray> cells;
  for (std::size_t face = 0; face < view->NumFaces(); ++face) {
    cells->InsertNextCell(static_cast<int>(view->FaceSize(face)));
    for (std::size_t i = 0; i < view->FaceSize(face); ++i) {
      cells->InsertCellPoint(static_cast<vtkIdType>(view->Corner(face, i)));
    }
  }
  surface->SetPolys(cells);
  AddData(document, *view->faces(), num_lines, {}, surface->GetCellData());
  return surface;
}

}  // namespace ceres_ed
