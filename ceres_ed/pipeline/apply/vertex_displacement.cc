#include "ceres_ed/pipeline/apply/vertex_displacement.h"

#include <algorithm>
#include <string>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Returns a column of zeros at the end of `element`, in place of one with the same name.
PlyProperty* NewColumn(const std::string& name, PlyType type, PlyElement* element) {
  auto& columns = element->properties;
  columns.erase(std::remove_if(columns.begin(),
                               columns.end(),
                               [&name](const PlyProperty& column) { return column.name == name; }),
                columns.end());
  columns.push_back(MakePlyScalar(name, type, std::vector<double>(element->count, 0.0)));
  return &columns.back();
}

}  // namespace

PlyDocument WithDisplacement(const LoadedCloud& loaded, const std::vector<Eigen::Vector3d>& moved) {
  CHECK_EQ(moved.size(), loaded.cloud.size()) << "one position a point";
  PlyDocument document = loaded.document;
  PlyElement* const vertices = document.Find("vertex");
  CHECK(vertices != nullptr) << "a cloud that was read has vertices";
  const PlyProperty* const x = vertices->Find("x");
  const bool is_float = x != nullptr && x->type == PlyType::kFloat32;
  for (int axis = 0; axis < 3; ++axis) {
    PlyProperty* const column = NewColumn("displacement_" + std::to_string(axis),
                                          is_float ? PlyType::kFloat32 : PlyType::kFloat64,
                                          vertices);
    for (std::size_t p = 0; p < moved.size(); ++p) {
      const auto row = static_cast<std::size_t>(loaded.vertex_of_point[p]);
      column->values[row] = moved[p][axis] - loaded.cloud.points[p][axis];
    }
  }
  const std::string line = "vtk_array vertex 3 vectors displacement_0 displacement";
  auto& lines = document.obj_info;
  if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  return document;
}

}  // namespace ceres_ed
