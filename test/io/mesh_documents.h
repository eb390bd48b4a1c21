// Documents for the tests of formats, and comparisons of them.
#ifndef CERES_ED_TEST_IO_MESH_DOCUMENTS_H_
#define CERES_ED_TEST_IO_MESH_DOCUMENTS_H_

#include <ceres_ed/io/mesh/ply_document.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {

inline PlyProperty FacesOf(const std::vector<std::vector<int>>& faces) {
  PlyProperty corners = MakePlyList("vertex_indices", PlyType::kUint8, PlyType::kInt32);
  for (const std::vector<int>& face : faces) {
    corners.list_sizes.push_back(static_cast<std::uint32_t>(face.size()));
    corners.values.insert(corners.values.end(), face.begin(), face.end());
  }
  return corners;
}

// Seven vertices whose coordinates have no short form in decimals, floats or doubles; a triangle, a
// quad, and an arrow head. Vertex 6 is in no face.
inline PlyDocument OddMesh(PlyType type) {
  PlyElement vertices;
  vertices.name = "vertex";
  vertices.count = 7;
  const std::vector<std::vector<double>> rows = {
      {2, 0, 0, 1, 0, 0, 1}, {2, 0, 2, 4, -1, 1, 1}, {0, 0, 0, 0, -1.0 / 3.0, 1e-7, -3e5}};
  const std::vector<std::string> names = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    PlyProperty column = MakePlyScalar(names[axis], type);
    for (std::size_t i = 0; i < 7; ++i) {
      const double value = rows[axis][i] + 0.1 * static_cast<double>(i) / 3.0;
      column.values.push_back(type == PlyType::kFloat32 ? static_cast<float>(value) : value);
    }
    vertices.properties.push_back(column);
  }
  PlyElement faces;
  faces.name = "face";
  faces.count = 3;
  faces.properties.push_back(FacesOf({{5, 4, 1}, {1, 2, 3, 0}, {0, 3, 2, 1}}));
  PlyDocument document;
  document.elements = {vertices, faces};
  return document;
}

inline void AddColumn(const std::string& element,
                      const std::string& name,
                      PlyType type,
                      const std::vector<double>& values,
                      PlyDocument* document) {
  document->Find(element)->properties.push_back(MakePlyScalar(name, type, values));
}

inline void AddColors(PlyDocument* document) {
  AddColumn("vertex", "red", PlyType::kUint8, {0, 255, 1, 128, 77, 3, 9}, document);
  AddColumn("vertex", "green", PlyType::kUint8, {10, 20, 30, 40, 50, 60, 70}, document);
  AddColumn("vertex", "blue", PlyType::kUint8, {254, 253, 85, 51, 17, 5, 3}, document);
}

inline void AddNormals(PlyType type, PlyDocument* document) {
  for (const char* const name : {"nx", "ny", "nz"}) {
    const double value = name[1] == 'x' ? 0.6 : name[1] == 'y' ? 0.0 : -0.8;
    const double kept = type == PlyType::kFloat32 ? static_cast<float>(value) : value;
    AddColumn("vertex", name, type, std::vector<double>(7, kept), document);
  }
}

// The values of columns must be equal in all bits; their types too if `with_types`.
inline void ExpectSameColumns(const PlyDocument& one,
                              const PlyDocument& other,
                              const std::string& element,
                              const std::vector<std::string>& names,
                              bool with_types = false) {
  ASSERT_NE(other.Find(element), nullptr) << element;
  for (const std::string& name : names) {
    const PlyProperty* const expected = one.Find(element)->Find(name);
    const PlyProperty* const found = other.Find(element)->Find(name);
    ASSERT_NE(found, nullptr) << element << ' ' << name;
    EXPECT_EQ(found->values, expected->values) << element << ' ' << name;
    EXPECT_EQ(found->list_sizes, expected->list_sizes) << element << ' ' << name;
    if (with_types) EXPECT_EQ(found->type, expected->type) << element << ' ' << name;
  }
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_IO_MESH_DOCUMENTS_H_
