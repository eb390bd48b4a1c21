// Colours of points.
#ifndef CERES_ED_PYTHON_COLORS_H_
#define CERES_ED_PYTHON_COLORS_H_

#include <ceres_ed/io/cloud_io.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

namespace ceres_ed::python {

// Red, green and blue of each point; empty if there are none.
using Colors = std::vector<std::array<std::uint8_t, 3>>;

// The colours of a surface, and their brightness (PointCloud::intensities).
struct PointColors {
  Colors colors;
  std::vector<double> intensities;
};

// Returns colours from (num_points, 3 or 4) uint8, or floats in [0, 1]; a fourth column (alpha) is
// not used. The brightness is the one that a file with these colours has. Raises a ValueError that
// names `what` for another shape, type or range.
PointColors ToColors(const pybind11::handle& object,
                     std::size_t num_points,
                     const std::string& what);

// Returns the colours that the object has: of vertices or faces (trimesh), `vertex_colors` or
// `colors` (Open3D). None if it has none. Colours of a texture are not used, with a UserWarning.
pybind11::object ColorsOfObject(const pybind11::object& object, const std::string& what);

// Returns the colours of a file; empty if it has none.
Colors ColorsOfFile(const LoadedCloud& file);

}  // namespace ceres_ed::python

#endif  // CERES_ED_PYTHON_COLORS_H_
