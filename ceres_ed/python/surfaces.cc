#include "ceres_ed/python/surfaces.h"

#include <ceres_ed/python/arrays.h>

#include <utility>

namespace ceres_ed::python {
namespace {

// Returns the attribute, or None if there is no such attribute.
py::object Attribute(const py::object& object, const char* name) {
  return py::getattr(object, name, py::none());
}

PointCloud FromArrays(const py::object& points,
                      const py::object& triangles,
                      const py::object& normals,
                      const std::string& what) {
  PointCloud cloud;
  cloud.points = ToPoints(points, what + "'s points");
  if (!IsNone(triangles)) {
    cloud.triangles = ToTriangles(triangles, cloud.size(), what + "'s triangles");
  }
  // Open3D has an empty list if there are no normals.
  if (!IsNone(normals) && py::len(normals) > 0) {
    cloud.normals = ToNormals(normals, cloud.size(), what + "'s normals");
  }
  return cloud;
}

// Reads a mesh or cloud of trimesh or Open3D. Returns false if `object` is not one. Normals of
// trimesh are not used, because trimesh computes them on request, and so does the library. Normals
// of Open3D are used, because they may come from a file.
bool FromObject(const py::object& object, const std::string& what, PointCloud* cloud) {
  if (py::hasattr(object, "to_legacy")) {  // a mesh or cloud of Open3D's tensors
    return FromObject(object.attr("to_legacy")(), what, cloud);
  }
  if (py::hasattr(object, "vertices")) {
    const py::object faces = Attribute(object, "faces");
    const bool is_trimesh = !IsNone(faces);
    *cloud = FromArrays(object.attr("vertices"),
                        is_trimesh ? faces : Attribute(object, "triangles"),
                        is_trimesh ? py::none() : Attribute(object, "vertex_normals"),
                        what);
    return true;
  }
  if (!py::hasattr(object, "points")) return false;
  *cloud = FromArrays(object.attr("points"), py::none(), Attribute(object, "normals"), what);
  return true;
}

bool IsPairOfArrays(const py::object& object) {
  // A list does not count, because a list of two points is a surface, too. In a tuple of two points
  // the second entry is not a matrix.
  if (!py::isinstance<py::tuple>(object) || py::len(object) != 2) return false;
  const py::array second = py::array::ensure(py::tuple(object)[1]);
  return second && (second.ndim() == 2 || second.size() == 0);
}

}  // namespace

SurfaceArgument::SurfaceArgument(const py::object& object, const std::string& what)
    : object_(object) {
  if (py::isinstance<Cloud>(object)) {
    const Cloud& cloud = object.cast<Cloud&>();
    shared_ = &cloud.cloud;
    if (cloud.file != nullptr) document_ = &cloud.file->document;
  } else if (py::isinstance<FittedSurface>(object)) {
    const FittedSurface& fitted = object.cast<FittedSurface&>();
    own_.points = fitted.result.points;
    own_.normals = fitted.result.normals;
    own_.normals_oriented = fitted.input.source.normals_oriented;
    own_.intensities = fitted.input.source.intensities;
    own_.triangles = fitted.input.source.triangles;
  } else if (IsPairOfArrays(object)) {
    const py::tuple pair = object;
    own_ = FromArrays(pair[0], pair[1], py::none(), what);
  } else if (py::isinstance<py::array>(object) || !FromObject(object, what, &own_)) {
    own_.points = ToPoints(object, what);
  }
}

}  // namespace ceres_ed::python
