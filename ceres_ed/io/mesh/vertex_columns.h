// Finds the columns of positions, normals and colours in a PLY element.
#ifndef CERES_ED_IO_MESH_VERTEX_COLUMNS_H_
#define CERES_ED_IO_MESH_VERTEX_COLUMNS_H_

#include <ceres_ed/io/mesh/ply_document.h>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include <Eigen/Core>

namespace ceres_ed {

// The indices into PlyElement::properties of three columns that form a vector.
using VertexColumns = std::array<std::size_t, 3>;

// Returns the scalar columns of these names, or nothing if one is missing or is a list.
inline std::optional<VertexColumns> FindColumns(const PlyElement& element,
                                                const std::array<const char*, 3>& names) {
  VertexColumns columns{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PlyProperty* const property = element.Find(names[i]);
    if (property == nullptr || property->is_list) return std::nullopt;
    columns[i] = static_cast<std::size_t>(property - element.properties.data());
  }
  return columns;
}

// Returns the columns x y z, or nothing.
inline std::optional<VertexColumns> FindPositionColumns(const PlyElement& element) {
  return FindColumns(element, {"x", "y", "z"});
}

// Returns the columns nx ny nz, otherwise normal_x normal_y normal_z, otherwise nothing.
inline std::optional<VertexColumns> FindNormalColumns(const PlyElement& element) {
  const std::optional<VertexColumns> columns = FindColumns(element, {"nx", "ny", "nz"});
  return columns.has_value() ? columns : FindColumns(element, {"normal_x", "normal_y", "normal_z"});
}

// Returns the columns red green blue, or nothing.
inline std::optional<VertexColumns> FindColorColumns(const PlyElement& element) {
  return FindColumns(element, {"red", "green", "blue"});
}

// Returns the vector in `row`.
inline Eigen::Vector3d RowOf(const PlyElement& element,
                             const VertexColumns& columns,
                             std::size_t row) {
  return {element.properties[columns[0]].values[row],
          element.properties[columns[1]].values[row],
          element.properties[columns[2]].values[row]};
}

// Appends three columns of `type` with these names. Each vector is one row.
template <typename Vectors>
void AppendVectorColumns(const Vectors& vectors,
                         const std::array<const char*, 3>& names,
                         PlyType type,
                         PlyElement* element) {
  for (int axis = 0; axis < 3; ++axis) {
    PlyProperty column = MakePlyScalar(names[static_cast<std::size_t>(axis)], type);
    column.values.reserve(vectors.size());
    for (const Eigen::Vector3d& vector : vectors) column.values.push_back(vector[axis]);
    element->properties.push_back(std::move(column));
  }
}

}  // namespace ceres_ed

#endif  // CERES_ED_IO_MESH_VERTEX_COLUMNS_H_
