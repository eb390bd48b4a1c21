// Deformable tracking and mapping, frame by frame.
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/graphs.h>
#include <ceres_ed/python/tracker.h>
#include <ceres_ed/slam/slam.h>

#include <optional>
#include <utility>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

py::dict Times(const FrameReport& report) {
  const FrameTimes& times = report.times;
  py::dict seconds;
  seconds["observe"] = times.observe;
  seconds["associate"] = times.associate;
  seconds["features"] = times.features;
  seconds["camera"] = times.camera;
  seconds["level1"] = times.level1;
  seconds["level2"] = times.level2;
  seconds["warp"] = times.warp;
  seconds["grow"] = times.grow;
  seconds["verify"] = times.verify;
  return seconds;
}

PinholeCamera MakeCamera(double fx, double fy, double cx, double cy, int width, int height) {
  const PinholeCamera camera = {fx, fy, cx, cy, width, height};
  std::string error;
  if (!camera.IsValid(&error)) throw py::value_error(error);
  return camera;
}

void BindCamera(py::module_& module) {
  using C = PinholeCamera;
  py::class_<C>(
      module, "Camera", "Intrinsics of a rectified picture, pixels; integers are pixel centres.")
      .def(py::init(&MakeCamera),
           py::arg("fx"),
           py::arg("fy"),
           py::arg("cx"),
           py::arg("cy"),
           py::arg("width"),
           py::arg("height"))
      .def_readonly("fx", &C::fx)
      .def_readonly("fy", &C::fy)
      .def_readonly("cx", &C::cx)
      .def_readonly("cy", &C::cy)
      .def_readonly("width", &C::width)
      .def_readonly("height", &C::height)
      .def("__repr__", [](const C& self) {
        return "Camera(fx=" + std::to_string(self.fx) + ", fy=" + std::to_string(self.fy) +
               ", cx=" + std::to_string(self.cx) + ", cy=" + std::to_string(self.cy) +
               ", width=" + std::to_string(self.width) + ", height=" + std::to_string(self.height) +
               ")";
      });
}

void BindReport(py::module_& module) {
  using R = FrameReport;
  py::class_<R>(module, "FrameReport", "What became of a frame.")
      .def_readonly("number", &R::number)
      .def_property_readonly(
          "status",
          [](const R& self) { return NameOf(self.status); },
          "'initialized', 'tracked', 'relocalized', 'lost' (the map is as it was) or 'skipped' "
          "(nothing to be seen).")
      .def_property_readonly("times", &Times, "Seconds by stage.")
      .def_readonly("nodes", &R::nodes)
      .def_readonly("point_relevant", &R::point_relevant, "Nodes with data.")
      .def_readonly("active", &R::active, "Nodes that level I has moved.")
      .def_readonly("updated_pi", &R::updated_pi, "Nodes that level II has moved, by wave.")
      .def_readonly("points", &R::points, "Map points with an observation in this frame.")
      .def_readonly("map_points", &R::map_points, "All points of the map.")
      .def_readonly("inliers", &R::inliers, "Map points near the observed surface.")
      .def_readonly("features", &R::features, "Corners that were followed.")
      .def_readonly("rms_plane", &R::rms_plane, "Of the inliers to their planes, metres.")
      .def_readonly("energy", &R::energy, "Of level I, no unit.")
      .def_readonly("iterations", &R::iterations, "Of level I.")
      .def("__repr__", [](const R& self) {
        return "<ceres_ed.FrameReport " + std::to_string(self.number) + ": " + NameOf(self.status) +
               ", " + std::to_string(self.nodes) + " nodes, " + std::to_string(self.map_points) +
               " points>";
      });
}

// (N,) on a vector of a snapshot.
template <typename T>
auto Column(std::vector<T> MapSnapshot::*column) {
  return [column](const py::object& self) {
    std::vector<T>& values = self.cast<MapSnapshot&>().*column;
    return py::array_t<T>({values.size()}, {sizeof(T)}, values.data(), self);
  };
}

void BindSnapshot(py::module_& module) {
  using S = MapSnapshot;
  py::class_<S>(module, "MapSnapshot", R"(The points of a map at one time, metres.

All arrays have a row a point and are views of the snapshot's memory.)")
      .def_property_readonly(
          "points",
          [](const py::object& self) { return View(self.cast<S&>().points, self); },
          "(N, 3)")
      .def_property_readonly(
          "normals",
          [](const py::object& self) { return View(self.cast<S&>().normals, self); },
          "(N, 3), unit length.")
      .def_property_readonly(
          "colors",
          [](const py::object& self) {
            std::vector<std::array<std::uint8_t, 3>>& colors = self.cast<S&>().colors;
            return View(reinterpret_cast<std::uint8_t*>(colors.data()), colors.size(), 3, self);
          },
          "(N, 3) uint8, red green blue.")
      .def_property_readonly("ids", Column(&S::ids), "(N,) int32, never reused.")
      .def_property_readonly(
          "birth_frames", Column(&S::birth_frames), "(N,) int32: the frame that saw it first.")
      .def_property_readonly(
          "weights", Column(&S::weights), "(N,) observations in the running average.")
      .def("__len__", [](const S& self) { return self.points.size(); });
}

void BindTrackerClass(py::module_& module) {
  py::class_<Tracker>(
      module, "Tracker", R"(Follows camera and tissue through depth frames, and maps them.

Lengths in metres. The map's frame is that of the first camera. One thread at a time: a call while another is at work is a RuntimeError.)")
      .def(py::init<const PinholeCamera&,
                    const SlamOptions*,
                    const py::object&,
                    const py::object&,
                    const py::kwargs&>(),
           py::arg("intrinsics"),
           py::arg("options") = nullptr,
           py::kw_only(),
           py::arg("energies") = py::none(),
           py::arg("plugin") = py::none(),
           R"(A tracker without a map.

Options are those of TrackerOptions, by keyword, on top of `options`; `energies` and `plugin` are as
of fit(). ValueError on bad ones.)")
      .def(
          "track",
          &Tracker::Track,
          py::arg("depth"),
          py::arg("color") = py::none(),
          py::arg("pose") = py::none(),
          py::kw_only(),
          py::arg("units_per_metre") = py::none(),
          py::arg("number") = py::none(),
          py::arg("catch_up") = false,
          R"(Takes the next frame in and returns its FrameReport. Other Python threads run meanwhile.

Args:
  depth: (height, width) along the optical axis; 0 or no number where there is none. Contiguous
    float32 metres are used as they are, anything else is converted.
  color: (height, width, 3) uint8, red green blue.
  pose: (4, 4) camera to world, metres, for camera='given'.
  units_per_metre: of `depth`, 1000 for millimetres; integers must have it.
  number: of the frame; None: the one after the last.
  catch_up: whether all of the map will be asked for after this frame.
Raises:
  ValueError: an image of another shape or type, or a pose that is none.)")
      .def("snapshot",
           &Tracker::Snapshot,
           py::arg("frame") = "map",
           R"(Returns a MapSnapshot of all points as they are now, in 'map' or 'camera' coordinates.

What was left behind out of view follows first.)")
      .def(
          "points",
          [](Tracker& self, const std::string& frame) {
            return OwnedView(self.Snapshot(frame).points);
          },
          py::arg("frame") = "map",
          "Returns the points of snapshot(frame), (N, 3).")
      .def_property_readonly(
          "camera_pose",
          [](const Tracker& self) -> py::object {
            const std::optional<Similarity> pose = self.CameraPose();
            if (!pose) return py::none();
            return ToMatrix(*pose);
          },
          "(4, 4) camera to map, metres; None before the first frame.")
      .def_property_readonly(
          "warp",
          [](Tracker& self) { return self.MakeWarp(); },
          "The Warp from where tissue is at rest to where it is now, map frame, metres; a copy.")
      .def_property_readonly(
          "graph",
          [](Tracker& self) {
            Warp warp = self.MakeWarp();
            Graph graph;
            graph.binding = warp.binding;
            graph.graph = std::move(warp.graph);
            return graph;
          },
          "The Graph at rest, map frame, metres; a copy.")
      .def_property_readonly(
          "point_relevant", &Tracker::PointRelevant, "(nodes,) bool: data in the last frame.")
      .def("__len__", &Tracker::NumPoints, "Points of the map.");
}

}  // namespace

void BindTracker(py::module_& module) {
  BindTrackerOptions(module);
  BindCamera(module);
  BindReport(module);
  BindSnapshot(module);
  BindTrackerClass(module);
}

}  // namespace ceres_ed::python
