#include "ceres_ed/python/landmarks.h"

#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/surfaces.h>

#include <utility>

namespace ceres_ed::python {
namespace {

Landmarks FromDict(const py::dict& places, const std::string& what) {
  Landmarks landmarks;
  if (places.empty()) throw py::value_error(what + " is empty, expected at least one landmark");
  for (const auto& [key, value] : places) {
    if (!py::isinstance<py::str>(key) || key.cast<std::string>().empty()) {
      throw py::type_error(what + " has the name " + std::string(py::repr(key)) +
                           ", expected a str that is not empty");
    }
    landmarks.points.push_back({key.cast<std::string>(), Eigen::Vector3d::Zero()});
  }
  const std::vector<Eigen::Vector3d> positions =
      ToPoints(py::list(places.attr("values")()), what + "'s positions");
  for (std::size_t i = 0; i < positions.size(); ++i) landmarks.points[i].position = positions[i];
  return landmarks;
}

Landmarks FromFile(const std::string& path, LandmarkSide side) {
  CheckReadable(path);
  Landmarks landmarks;
  landmarks.path = path;
  landmarks.file = ValueOrThrow(ReadLandmarkFile(path, side));
  landmarks.points = landmarks.file.points;
  landmarks.space = landmarks.file.space;
  return landmarks;
}

}  // namespace

Landmarks ToNamedLandmarks(const py::object& object, const std::string& what, LandmarkSide side) {
  if (py::isinstance<Landmarks>(object)) return object.cast<const Landmarks&>();
  if (py::isinstance<py::dict>(object)) return FromDict(object, what);
  if (IsPath(object)) return FromFile(ToPath(object), side);
  throw py::type_error(what + " is " + std::string(py::str(py::type::of(object))) +
                       ", expected Landmarks, {name: (x, y, z)}, or the path of a file");
}

}  // namespace ceres_ed::python
