#include "ceres_ed/io/cloud_io.h"

#include <ceres_ed/io/mesh/mesh_format.h>
#include <ceres_ed/io/mesh/position_type.h>
#include <ceres_ed/io/mesh/vertex_columns.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Replaces the vectors of some rows. A column of integers becomes double, since rounding positions
// to integers would destroy them; with `as_doubles` every column does.
void ReplaceRows(const std::vector<Eigen::Vector3d>& vectors,
                 const std::vector<int>& rows,
                 const VertexColumns& columns,
                 bool as_doubles,
                 PlyElement* element) {
  for (std::size_t axis = 0; axis < columns.size(); ++axis) {
    PlyProperty& property = element->properties[columns[axis]];
    if (as_doubles || !IsFloatingPlyType(property.type)) property.type = PlyType::kFloat64;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      property.values[static_cast<std::size_t>(rows[i])] =
          vectors[i][static_cast<Eigen::Index>(axis)];
    }
  }
}

PlyElement MakeVertexElement(const PointCloud& cloud, const CloudWriteOptions& options) {
  PlyElement vertices;
  vertices.name = "vertex";
  vertices.count = cloud.size();
  const PlyType type = options.double_precision ? PlyType::kFloat64 : PlyType::kFloat32;
  const PlyType position_type = options.double_precision ? type : PositionType(cloud.points);
  AppendVectorColumns(cloud.points, {"x", "y", "z"}, position_type, &vertices);
  if (cloud.HasNormals()) AppendVectorColumns(cloud.normals, {"nx", "ny", "nz"}, type, &vertices);
  if (!options.colors.empty()) {
    CHECK_EQ(options.colors.size(), cloud.size()) << "one color a point";
    constexpr std::array<const char*, 3> kNames = {"red", "green", "blue"};
    for (std::size_t channel = 0; channel < kNames.size(); ++channel) {
      PlyProperty column = MakePlyScalar(kNames[channel], PlyType::kUint8);
      for (const auto& color : options.colors) column.values.push_back(color[channel]);
      vertices.properties.push_back(std::move(column));
    }
  }
  for (const PlyProperty& column : options.columns) {
    CHECK(!column.is_list) << "column " << column.name << " must be scalar";
    vertices.properties.push_back(column);
  }
  return vertices;
}

PlyElement MakeFaceElement(const PointCloud& cloud) {
  PlyElement faces;
  faces.name = "face";
  faces.count = cloud.triangles.size();
  PlyProperty corners = MakePlyList("vertex_indices", PlyType::kUint8, PlyType::kInt32);
  corners.list_sizes.assign(faces.count, 3);
  corners.values.reserve(3 * faces.count);
  for (const std::array<int, 3>& triangle : cloud.triangles) {
    corners.values.insert(corners.values.end(), triangle.begin(), triangle.end());
  }
  faces.properties.push_back(std::move(corners));
  return faces;
}

}  // namespace

PlyDocument MoveVertices(const PlyDocument& original,
                         const std::vector<int>& vertex_of_point,
                         const std::vector<Eigen::Vector3d>& points,
                         const std::vector<Eigen::Vector3d>* normals) {
  CHECK_EQ(points.size(), vertex_of_point.size()) << "one row a point";
  PlyDocument document = original;
  PlyElement* const vertices = document.Find("vertex");
  CHECK(vertices != nullptr) << "the original has no vertices";
  for (const int row : vertex_of_point) {
    CHECK(row >= 0 && static_cast<std::size_t>(row) < vertices->count) << "row " << row;
  }
  const std::optional<VertexColumns> position_columns = FindPositionColumns(*vertices);
  CHECK(position_columns.has_value()) << "the original has no x y z";
  ReplaceRows(points, vertex_of_point, *position_columns, NeedsDoubles(points), vertices);
  const std::optional<VertexColumns> normal_columns = FindNormalColumns(*vertices);
  if (normals != nullptr && normal_columns.has_value()) {
    CHECK_EQ(normals->size(), points.size()) << "one normal a point";
    ReplaceRows(*normals, vertex_of_point, *normal_columns, /*as_doubles=*/false, vertices);
  }
  return document;
}

Status SaveCloud(const std::string& path,
                 const PlyDocument& original,
                 const std::vector<int>& vertex_of_point,
                 const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Vector3d>* normals) {
  return WriteMesh(path, MoveVertices(original, vertex_of_point, points, normals));
}

Status WriteCloud(const std::string& path,
                  const PointCloud& cloud,
                  const CloudWriteOptions& options) {
  PlyDocument document;
  document.format = options.format;
  document.comments = options.comments;
  document.elements.push_back(MakeVertexElement(cloud, options));
  if (cloud.HasTriangles()) document.elements.push_back(MakeFaceElement(cloud));
  if (options.losses != nullptr) *options.losses = LossesOf(path, document);
  return WriteMesh(path, document);
}

Status SaveCloud(const std::string& path,
                 const LoadedCloud& original,
                 const std::vector<Eigen::Vector3d>& points,
                 const std::vector<Eigen::Vector3d>* normals) {
  return SaveCloud(path, original.document, original.vertex_of_point, points, normals);
}

}  // namespace ceres_ed
