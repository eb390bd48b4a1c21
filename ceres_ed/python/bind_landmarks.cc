// Binds landmarks: points with names, read from and written to the files of other tools.
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/landmarks.h>
#include <ceres_ed/python/pickles.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

std::optional<std::string> NameOfSpace(AnatomicalSpace space) {
  if (space == AnatomicalSpace::kUnknown) return std::nullopt;
  return space == AnatomicalSpace::kRas ? "RAS" : "LPS";
}

AnatomicalSpace ToSpace(const std::optional<std::string>& name) {
  if (!name.has_value()) return AnatomicalSpace::kUnknown;
  if (*name == "LPS") return AnatomicalSpace::kLps;
  if (*name == "RAS") return AnatomicalSpace::kRas;
  throw py::value_error("space is '" + *name + "', expected 'LPS', 'RAS' or None");
}

Landmarks MakeLandmarks(const py::object& points, const std::optional<std::string>& space) {
  if (!py::isinstance<py::dict>(points)) {
    throw py::type_error("points is " + std::string(py::str(py::type::of(points))) +
                         ", expected {name: (x, y, z)}; Landmarks.load() reads files");
  }
  Landmarks landmarks = ToNamedLandmarks(points, "points", LandmarkSide::kSource);
  landmarks.space = ToSpace(space);
  return landmarks;
}

Landmarks LoadLandmarks(const py::object& path, const std::string& side) {
  if (side != "source" && side != "target") {
    throw py::value_error("side is '" + side + "', expected 'source' or 'target'");
  }
  return ToNamedLandmarks(py::str(ToPath(path)),
                          "path",
                          side == "source" ? LandmarkSide::kSource : LandmarkSide::kTarget);
}

std::vector<std::string> NamesOf(const Landmarks& self) {
  std::vector<std::string> names;
  for (const NamedLandmark& point : self.points) names.push_back(point.name);
  return names;
}

py::array PositionsOf(const Landmarks& self) {
  std::vector<Eigen::Vector3d> positions;
  for (const NamedLandmark& point : self.points) positions.push_back(point.position);
  return ReadOnly(OwnedView(std::move(positions)));
}

py::array PositionOf(const Landmarks& self, const std::string& name) {
  for (const NamedLandmark& point : self.points) {
    if (point.name == name) return py::array_t<double>(3, point.position.data());
  }
  throw py::key_error("no landmark is named '" + name + "'");
}

Landmarks At(const Landmarks& self, const py::object& object) {
  const std::vector<Eigen::Vector3d> positions = ToPoints(object, "positions");
  if (positions.size() != self.points.size()) {
    throw py::value_error("positions has " + std::to_string(positions.size()) +
                          " rows, expected one for each of " + std::to_string(self.points.size()) +
                          " landmarks");
  }
  Landmarks moved = self;
  for (std::size_t i = 0; i < positions.size(); ++i) moved.points[i].position = positions[i];
  return moved;
}

Landmarks InSpace(const Landmarks& self, const std::string& name) {
  const AnatomicalSpace space = ToSpace(name);
  if (self.space == AnatomicalSpace::kUnknown) {
    throw py::value_error(
        "the space of the landmarks is not known; Landmarks(dict(landmarks), space='LPS') says it");
  }
  Landmarks turned = self;
  for (NamedLandmark& point : turned.points) {
    point.position = BetweenSpaces(point.position, self.space, space);
  }
  turned.space = space;
  return turned;
}

// A file of the same ending keeps all that the first one had beside the positions.
void SaveLandmarks(const Landmarks& self, const py::object& path_object) {
  const std::string path = ToPath(path_object);
  const bool is_same_format =
      !self.path.empty() &&
      std::filesystem::path(path).extension() == std::filesystem::path(self.path).extension();
  if (!is_same_format) {
    ThrowUnlessWritten(WriteNewLandmarkFile(path, self.points, self.space));
    return;
  }
  std::vector<Eigen::Vector3d> positions;
  for (const NamedLandmark& point : self.points) {
    positions.push_back(BetweenSpaces(point.position, self.space, self.file.space));
  }
  ThrowUnlessWritten(WriteLandmarkFile(path, self.file, positions));
}

}  // namespace

void BindLandmarks(py::module_& module) {
  py::class_<Landmarks> landmarks(
      module, "Landmarks", R"(Points with names, which cannot be changed.

`dict(landmarks)` gives {name: position}. Positions are as in the file; `to()` turns them between
the axes left-posterior-superior (LPS) and right-anterior-superior (RAS).)");
  landmarks
      .def(
          py::init(&MakeLandmarks),
          py::arg("points"),
          py::arg("space") = py::none(),
          "Takes {name: (x, y, z)}, and the space of the positions: 'LPS', 'RAS', or None if it is "
          "not known.")
      .def_static("load",
                  &LoadLandmarks,
                  py::arg("path"),
                  py::arg("side") = "source",
                  R"(Returns the landmarks of a file: .json (markups of 3D Slicer, and Scalismo's),
.fcsv, .pts or .csv.

Of a .csv whose columns are source_x ... target_z, `side` ('source' or 'target') says which are
read. Raises an OSError if the file can't be read, and a ValueError that names the place if it is
not such a file.)")
      .def("save",
           &SaveLandmarks,
           py::arg("path"),
           R"(Writes a file in the format of its ending, completely or not at all.

If the landmarks were read from a file of that ending, all else in it is kept, also its space.
Raises an OSError if the file can't be written, or can't hold a name or an unknown space.)")
      .def("at",
           &At,
           py::arg("positions"),
           "Returns the same landmarks at other positions (N, 3), in their space.")
      .def("to",
           &InSpace,
           py::arg("space"),
           "Returns the landmarks in 'LPS' or 'RAS': x and y change their signs if the space "
           "differs.")
      .def("keys", &NamesOf, "Returns the names.")
      .def("__getitem__", &PositionOf, py::arg("name"), "Returns the position (3,) of a landmark.")
      .def("__len__", [](const Landmarks& self) { return self.points.size(); })
      .def("__repr__",
           [](const Landmarks& self) {
             const std::optional<std::string> space = NameOfSpace(self.space);
             return "<ceres_ed.Landmarks of " + std::to_string(self.points.size()) + " points" +
                    (space.has_value() ? " in " + *space : "") + ">";
           })
      .def_property_readonly("names", &NamesOf, "The names, in the order of the file.")
      .def_property_readonly("positions", &PositionsOf, "The positions, (N, 3) float64; a copy.")
      .def_property_readonly(
          "space",
          [](const Landmarks& self) { return NameOfSpace(self.space); },
          "'LPS' or 'RAS'; None if nothing says it.")
      .def_property_readonly(
          "warnings",
          [](const Landmarks& self) { return self.file.warnings; },
          "What was left out or guessed when the file was read, a sentence for each kind.");
  AddPickle(&landmarks);
}

}  // namespace ceres_ed::python
