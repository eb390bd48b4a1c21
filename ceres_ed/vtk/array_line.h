// How an array of VTK is kept in a document: its components are columns, and an obj_info line says
// what they were, so that the array can be written again.
#ifndef CERES_ED_VTK_ARRAY_LINE_H_
#define CERES_ED_VTK_ARRAY_LINE_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// The line `vtk_array ELEMENT COMPONENTS ROLE COLUMN NAME`, for example
// `vtk_array vertex 3 normals nx Point Normals`.
struct ArrayLine {
  // The element of the columns: vertex or face.
  std::string element;
  std::size_t components = 1;
  // The attribute for which VTK uses the array: scalars, vectors, normals, tcoords, tensors or
  // none.
  std::string role = "none";
  // The first column; the others follow it.
  std::string column;
  // The name in VTK, which may have blanks.
  std::string name;

  std::string Format() const;
  static std::optional<ArrayLine> Parse(const std::string& line);
};

// Returns the names of the columns of an array. A single component is one column `base`. Normals
// and colours have the names of PLY if `is_normals` or `is_colors`.
std::vector<std::string> ColumnNames(const std::string& base,
                                     std::size_t components,
                                     bool is_normals,
                                     bool is_colors);

}  // namespace ceres_ed

#endif  // CERES_ED_VTK_ARRAY_LINE_H_
