// Binds surfaces, in memory and in files.
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/pickles.h>
#include <ceres_ed/python/surfaces.h>

#include <utility>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

Cloud MakeCloud(const py::object& points,
                const py::object& triangles,
                const py::object& normals,
                const py::object& colors) {
  Cloud cloud;
  if (IsPath(points)) {
    cloud = LoadFile(ToPath(points));
  } else {
    SurfaceArgument surface(points, "points");
    cloud.colors = surface.colors();
    cloud.cloud = std::move(surface).Take();
  }
  if (!IsNone(triangles)) {
    cloud.cloud.triangles = ToTriangles(triangles, cloud.cloud.size(), "triangles");
  }
  if (!IsNone(normals)) cloud.cloud.normals = ToNormals(normals, cloud.cloud.size(), "normals");
  if (!IsNone(colors)) {
    PointColors given = ToColors(colors, cloud.cloud.size(), "colors");
    cloud.colors = std::move(given.colors);
    cloud.cloud.intensities = std::move(given.intensities);
  }
  return cloud;
}

Status Write(const std::string& path,
             const SurfaceArgument& surface,
             const Cloud* like,
             bool double_precision) {
  const py::gil_scoped_release release;
  const PointCloud& cloud = *surface;
  if (like == nullptr || like->file == nullptr) {
    CloudWriteOptions options;
    options.double_precision = double_precision;
    options.colors = like != nullptr && !like->colors.empty() ? like->colors : surface.colors();
    return WriteCloud(path, cloud, options);
  }
  const std::vector<Eigen::Vector3d>* normals = cloud.HasNormals() ? &cloud.normals : nullptr;
  const LoadedCloud& file = *like->file;
  return SaveCloud(path, file.document, file.vertex_of_point, cloud.points, normals);
}

void Save(const py::object& path,
          const py::object& surface_object,
          const py::object& like_object,
          bool double_precision) {
  const SurfaceArgument surface(surface_object, "the surface");
  Cloud file;
  const Cloud* like = nullptr;
  if (IsPath(like_object)) {
    file = LoadFile(ToPath(like_object));
    like = &file;
  } else if (!like_object.is_none()) {
    if (!py::isinstance<Cloud>(like_object)) {
      throw py::type_error("like is " + std::string(py::str(py::type::of(like_object))) +
                           ", expected a Cloud or the path of a file");
    }
    like = &like_object.cast<const Cloud&>();
  } else if (py::isinstance<Cloud>(surface_object)) {
    like = &surface_object.cast<const Cloud&>();
  }
  if (like != nullptr && like->cloud.size() != (*surface).size()) {
    throw py::value_error("the surface has " + std::to_string((*surface).size()) +
                          " points, expected as many as `like`, " +
                          std::to_string(like->cloud.size()));
  }
  ThrowUnlessWritten(Write(ToPath(path), surface, like, double_precision));
}

std::string Describe(const Cloud& cloud) {
  return "<ceres_ed.Cloud of " + std::to_string(cloud.cloud.size()) + " points, " +
         std::to_string(cloud.cloud.triangles.size()) + " triangles>";
}

}  // namespace

void BindCloud(py::module_& module) {
  py::class_<Cloud> cloud(module, "Cloud", R"(Points with optional triangles and normals.

A function that takes a surface also accepts an (N, 3) array of points, a pair (points,
triangles), a mesh or cloud of trimesh or Open3D, a FitResult, and the path of a file. Lengths are in the unit of the
input.)");
  cloud
      .def(py::init(&MakeCloud),
           py::arg("points"),
           py::arg("triangles") = py::none(),
           py::arg("normals") = py::none(),
           py::arg("colors") = py::none(),
           R"(Copies `points` (N, 3) or any other surface, `triangles` (M, 3), `normals` (N, 3).

Normals are scaled to unit length. `colors` (N, 3) are uint8, or floats in [0, 1]; the energy
`photometric` compares their brightness. Raises a ValueError for other shapes, for coordinates that are
not finite, and for triangles with an index that is out of range.)")
      .def_property_readonly(
          "points",
          [](const py::object& self) { return View(self.cast<Cloud&>().cloud.points, self); },
          "The points, (N, 3) float64; a view that cannot be written.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            return ViewOrNone(self.cast<Cloud&>().cloud.triangles, self);
          },
          "The triangles, (M, 3) int32; a view. None for bare points.")
      .def_property_readonly(
          "normals",
          [](const py::object& self) {
            return ViewOrNone(self.cast<Cloud&>().cloud.normals, self);
          },
          "The normals of unit length, (N, 3) float64; a view. None if there are none.")
      .def_property_readonly(
          "colors",
          [](const py::object& self) -> py::object {
            Colors& colors = self.cast<Cloud&>().colors;
            if (colors.empty()) return py::none();
            return ColorView(colors, self);
          },
          "Red, green and blue, (N, 3) uint8; a view. None if there are none.")
      .def_property_readonly(
          "warnings",
          [](const Cloud& self) {
            return self.file == nullptr ? std::vector<std::string>() : self.file->warnings;
          },
          "A sentence for each kind of thing that was left out of the file.")
      .def("__len__", [](const Cloud& self) { return self.cloud.size(); })
      .def("__repr__", &Describe);
  AddPickle(&cloud);

  const auto load = [](const py::object& path) { return LoadFile(ToPath(path)); };
  module.def("load", load, py::arg("path"), R"(Returns the Cloud in a file.

Raises an OSError if the file can't be read, and a ValueError that names the file, the place and
what was expected if its contents can't be used.)");
  module.def("save",
             &Save,
             py::arg("path"),
             py::arg("surface"),
             py::kw_only(),
             py::arg("like") = py::none(),
             py::arg("double_precision") = false,
             R"(Writes `surface` to a file. The file is written completely or not at all.

If `surface` is a Cloud that was loaded, or if such a Cloud with as many points (or the path of its
file) is given as `like`, everything else in its file is kept: order, faces, colours, all other properties, and
types. Raises an OSError if the file can't be written.)");
}

}  // namespace ceres_ed::python
