#include "ceres_ed/python/surfaces.h"

#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/errors.h>

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
bool FromObject(const py::object& object,
                const std::string& what,
                PointCloud* cloud,
                Colors* colors) {
  if (py::hasattr(object, "to_legacy")) {  // a mesh or cloud of Open3D's tensors
    return FromObject(object.attr("to_legacy")(), what, cloud, colors);
  }
  if (py::hasattr(object, "vertices")) {
    const py::object faces = Attribute(object, "faces");
    const bool is_trimesh = !IsNone(faces);
    *cloud = FromArrays(object.attr("vertices"),
                        is_trimesh ? faces : Attribute(object, "triangles"),
                        is_trimesh ? py::none() : Attribute(object, "vertex_normals"),
                        what);
  } else if (py::hasattr(object, "points")) {
    *cloud = FromArrays(object.attr("points"), py::none(), Attribute(object, "normals"), what);
  } else {
    return false;
  }
  if (const py::object given = ColorsOfObject(object, what); !given.is_none()) {
    PointColors found = ToColors(given, cloud->size(), what + "'s colors");
    *colors = std::move(found.colors);
    cloud->intensities = std::move(found.intensities);
  }
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

bool IsPath(const py::handle& object) {
  return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__");
}

Cloud LoadFile(const std::string& path) {
  CheckReadable(path);
  const auto load = [&path] {
    const py::gil_scoped_release release;
    return LoadCloud(path);
  };
  LoadedCloud loaded = ValueOrThrow(load());
  Cloud cloud;
  cloud.colors = ColorsOfFile(loaded);
  cloud.cloud = std::move(loaded.cloud);
  loaded.cloud = PointCloud();
  cloud.file = std::make_unique<LoadedCloud>(std::move(loaded));
  return cloud;
}

SurfaceArgument::SurfaceArgument(const py::object& object, const std::string& what)
    : object_(object) {
  if (py::isinstance<Cloud>(object)) {
    const Cloud& cloud = object.cast<Cloud&>();
    shared_ = &cloud.cloud;
    shared_colors_ = &cloud.colors;
    if (cloud.file != nullptr) document_ = &cloud.file->document;
  } else if (py::isinstance<FittedSurface>(object)) {
    const FittedSurface& fitted = object.cast<FittedSurface&>();
    own_.points = fitted.result.points;
    own_.normals = fitted.result.normals;
    own_.normals_oriented = fitted.input.source.normals_oriented;
    own_.intensities = fitted.input.source.intensities;
    own_.triangles = fitted.input.source.triangles;
    own_colors_ = fitted.colors;
  } else if (IsPath(object)) {
    Cloud cloud = LoadFile(ToPath(object));
    own_ = std::move(cloud.cloud);
    own_colors_ = std::move(cloud.colors);
    own_file_ = std::move(cloud.file);
    document_ = &own_file_->document;
  } else if (IsPairOfArrays(object)) {
    const py::tuple pair = object;
    own_ = FromArrays(pair[0], pair[1], py::none(), what);
  } else if (py::isinstance<py::array>(object) || !FromObject(object, what, &own_, &own_colors_)) {
    const bool may_be_points =
        py::isinstance<py::array>(object) ||
        (py::isinstance<py::sequence>(object) && !py::isinstance<py::bytes>(object));
    if (!may_be_points && !py::hasattr(object, "__array__")) {
      throw py::value_error(what + " is " + std::string(py::str(py::type::of(object))) +
                            ", expected a surface: an (N, 3) array of points, a pair (points, "
                            "triangles), a mesh or cloud, or the path of a file");
    }
    own_.points = ToPoints(object, what);
  }
}

}  // namespace ceres_ed::python
