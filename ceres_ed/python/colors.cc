#include "ceres_ed/python/colors.h"

#include <ceres_ed/io/mesh/vertex_columns.h>
#include <ceres_ed/python/arrays.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace ceres_ed::python {
namespace {

constexpr double kLargest = 255.0;

// Rec. 601 luma, as for files.
const Eigen::Vector3d& Luminance() {
  static const Eigen::Vector3d luminance(0.299, 0.587, 0.114);
  return luminance;
}

// Returns the largest colour of a type. Colours that are floats are in [0, 1].
double LargestOf(PlyType type) {
  if (IsFloatingPlyType(type)) return 1.0;
  const bool is_signed =
      type == PlyType::kInt8 || type == PlyType::kInt16 || type == PlyType::kInt32;
  return std::ldexp(1.0, static_cast<int>(8 * PlyTypeSize(type)) - (is_signed ? 1 : 0)) - 1.0;
}

std::uint8_t ToByte(double share) {
  return static_cast<std::uint8_t>(std::lround(kLargest * std::clamp(share, 0.0, 1.0)));
}

// Returns the attribute, or None if there is no such attribute.
py::object Attribute(const py::object& object, const char* name) {
  return py::getattr(object, name, py::none());
}

bool HasRows(const py::object& rows) { return !IsNone(rows) && py::len(rows) > 0; }

}  // namespace

PointColors ToColors(const py::handle& object, std::size_t num_points, const std::string& what) {
  const py::array given = py::array::ensure(object);
  const bool is_bytes = given && given.dtype().kind() == 'u' && given.itemsize() == 1;
  if (!given || (!is_bytes && given.dtype().kind() != 'f')) {
    throw py::value_error(what + ": expected an array of uint8, or of floats in [0, 1]");
  }
  const auto values = Doubles(given, what);
  const bool has_shape = values.ndim() == 2 && (values.shape(1) == 3 || values.shape(1) == 4);
  if (!has_shape || static_cast<std::size_t>(values.shape(0)) != num_points) {
    throw py::value_error(what + " has shape " + std::string(py::str(given.attr("shape"))) +
                          ", expected (" + std::to_string(num_points) + ", 3), one row a point");
  }
  const double largest = is_bytes ? kLargest : 1.0;
  const Eigen::Vector3d share = Luminance() / largest;
  PointColors result;
  for (py::ssize_t i = 0; i < values.shape(0); ++i) {
    const Eigen::Vector3d color(values.at(i, 0), values.at(i, 1), values.at(i, 2));
    if (color.allFinite() && (color.minCoeff() < 0.0 || color.maxCoeff() > largest)) {
      throw py::value_error(what + " has a colour outside [0, 1] in row " + std::to_string(i));
    }
    // A colour that is not finite is unknown, as in a file.
    const bool known = color.allFinite();
    result.intensities.push_back(known ? std::clamp(share.dot(color), 0.0, 1.0)
                                       : std::numeric_limits<double>::quiet_NaN());
    const Eigen::Vector3d shown =
        known ? Eigen::Vector3d(color / largest) : Eigen::Vector3d::Zero();
    result.colors.push_back({ToByte(shown[0]), ToByte(shown[1]), ToByte(shown[2])});
  }
  return result;
}

py::object ColorsOfObject(const py::object& object, const std::string& what) {
  const py::object visual = Attribute(object, "visual");
  if (!IsNone(visual)) {
    // trimesh makes up colours for a mesh that has none; its kind says so.
    const py::object kind = Attribute(visual, "kind");
    const std::string name = py::isinstance<py::str>(kind) ? kind.cast<std::string>() : "";
    if (name == "vertex" || name == "face") return visual.attr("vertex_colors");
    if (name == "texture") {
      const std::string text = what +
                               ": the colours of its texture are not used; "
                               "mesh.visual.to_color() turns them into colours of vertices";
      if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
    }
    return py::none();
  }
  // Open3D has an empty list if there are none.
  for (const char* name : {"vertex_colors", "colors"}) {
    if (py::object colors = Attribute(object, name); HasRows(colors)) return colors;
  }
  return py::none();
}

Colors ColorsOfFile(const LoadedCloud& file) {
  Colors colors;
  const PlyElement* const vertices = file.document.Find("vertex");
  if (vertices == nullptr) return colors;
  const std::optional<VertexColumns> columns = FindColorColumns(*vertices);
  if (!columns.has_value()) return colors;
  Eigen::Vector3d largest;
  for (int i = 0; i < 3; ++i) largest[i] = LargestOf(vertices->properties[(*columns)[i]].type);
  colors.reserve(file.vertex_of_point.size());
  for (const int row : file.vertex_of_point) {
    const Eigen::Vector3d color = RowOf(*vertices, *columns, static_cast<std::size_t>(row));
    std::array<std::uint8_t, 3> bytes = {};
    for (int i = 0; i < 3; ++i)
      bytes[i] = std::isfinite(color[i]) ? ToByte(color[i] / largest[i]) : 0;
    colors.push_back(bytes);
  }
  return colors;
}

}  // namespace ceres_ed::python
