// Binds deformable tracking and mapping, which processes one frame after another.
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
      module, "Camera", "The intrinsics of rectified images in pixels. Integers are pixel centres.")
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
  py::class_<R>(module, "FrameReport", "The report on a frame.")
      .def_readonly("number", &R::number)
      .def_property_readonly(
          "status",
          [](const R& self) { return NameOf(self.status); },
          "'initialized', 'tracked', 'relocalized', 'lost' (the map is unchanged) or 'skipped' "
          "(there is no usable depth).")
      .def_property_readonly("times", &Times, "The seconds of each stage.")
      .def_readonly("nodes", &R::nodes)
      .def_readonly("point_relevant", &R::point_relevant, "The number of nodes with data.")
      .def_readonly("active", &R::active, "The number of nodes that Level I has moved.")
      .def_readonly("updated_pi",
                    &R::updated_pi,
                    "The number of PI nodes that Level II has moved, summed over its waves.")
      .def_readonly(
          "points", &R::points, "The number of map points with an observation in this frame.")
      .def_readonly("map_points", &R::map_points, "The number of all points of the map.")
      .def_readonly("inliers", &R::inliers, "The number of map points near the observed surface.")
      .def_readonly("features", &R::features, "The number of corners that were followed.")
      .def_readonly("explained",
                    &R::explained,
                    "The share of the measured surface that has a counterpart in the map.")
      .def_readonly(
          "overlap",
          &R::overlap,
          "The share of the points in view, where the surface is measured, that lie on it.")
      .def_property_readonly(
          "camera_covariance",
          [](const R& self) -> py::object {
            if (!self.camera_covariance.has_value()) return py::none();
            // Symmetric, so the order of its entries does not matter.
            return py::array_t<double>({6, 6}, self.camera_covariance->data());
          },
          "The covariance of camera to map, (6, 6): the position in the map frame (metres), then a "
          "rotation vector in the camera frame (radians). None without covariance=True.")
      .def_readonly("weak_directions",
                    &R::weak_directions,
                    "The number of directions of the camera's motion that are not determined.")
      .def_readonly("tentative",
                    &R::tentative,
                    "The share of the points in view that were seen in fewer than 4 frames.")
      .def_readonly("rms_plane",
                    &R::rms_plane,
                    "The root mean square distance of the inliers to their planes, in metres.")
      .def_readonly("energy", &R::energy, "The energy of Level I, without unit.")
      .def_readonly("iterations", &R::iterations, "The number of iterations of Level I.")
      .def("__repr__", [](const R& self) {
        return "<ceres_ed.FrameReport " + std::to_string(self.number) + ": " + NameOf(self.status) +
               ", " + std::to_string(self.nodes) + " nodes, " + std::to_string(self.map_points) +
               " points>";
      });
}

// Returns a getter of the (N,) array that shows a vector of a snapshot.
template <typename T>
auto Column(std::vector<T> MapSnapshot::*column) {
  return [column](const py::object& self) {
    std::vector<T>& values = self.cast<MapSnapshot&>().*column;
    return ReadOnly(py::array_t<T>({values.size()}, {sizeof(T)}, values.data(), self));
  };
}

void BindSnapshot(py::module_& module) {
  using S = MapSnapshot;
  py::class_<S>(module, "MapSnapshot", R"(The points of a map at one time. Lengths are in metres.

All arrays have one row for each point and are views of the snapshot's memory.)")
      .def_property_readonly(
          "points",
          [](const py::object& self) { return View(self.cast<S&>().points, self); },
          "The positions, (N, 3).")
      .def_property_readonly(
          "normals",
          [](const py::object& self) { return View(self.cast<S&>().normals, self); },
          "The normals of unit length, (N, 3).")
      .def_property_readonly(
          "colors",
          [](const py::object& self) {
            std::vector<std::array<std::uint8_t, 3>>& colors = self.cast<S&>().colors;
            return ColorView(colors, self);
          },
          "Red, green and blue, (N, 3) uint8.")
      .def_property_readonly(
          "ids", Column(&S::ids), "The numbers of the points, (N,) int32. They are never reused.")
      .def_property_readonly("birth_frames",
                             Column(&S::birth_frames),
                             "The frames in which the points were first seen, (N,) int32.")
      .def_property_readonly("weights",
                             Column(&S::weights),
                             "The numbers of observations in the running averages, (N,).")
      .def_property_readonly(
          "stabilities", Column(&S::stabilities), "How certain the points are, in [0, 1], (N,).")
      .def_property_readonly("last_seen",
                             Column(&S::last_seen),
                             "The last frames in which the camera saw the points, (N,) int32.")
      .def("__len__", [](const S& self) { return self.points.size(); })
      .def("__repr__", [](const S& self) {
        return "<ceres_ed.MapSnapshot of " + std::to_string(self.points.size()) + " points>";
      });
}

// What a tracker tells of its map.
void BindTrackerMap(py::class_<Tracker>* tracker) {
  (*tracker)
      .def("snapshot",
           &Tracker::Snapshot,
           py::arg("frame") = "map",
           R"(Returns a MapSnapshot of the current points, in 'map' or 'camera' coordinates.

Nodes out of view that lazy Level II has not moved yet are moved first.)")
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
          "The pose of the camera, (4, 4) camera to map, in metres; None before the first frame.")
      .def_property_readonly(
          "warp",
          [](Tracker& self) { return self.MakeWarp(); },
          "The Warp from the rest shape of the tissue to its current shape, in the map frame, in "
          "metres; a copy.")
      .def_property_readonly(
          "graph",
          [](Tracker& self) {
            Warp warp = self.MakeWarp();
            Graph graph;
            graph.binding = warp.binding;
            graph.graph = std::move(warp.graph);
            return graph;
          },
          "The Graph of the rest shape, in the map frame and in metres; a copy.")
      .def_property_readonly(
          "point_relevant",
          &Tracker::PointRelevant,
          "(nodes,) bool: whether the node had data in the last tracked frame, or was added in it.")
      .def("__len__", &Tracker::NumPoints, "Returns the number of points of the map.")
      .def("__repr__", [](const Tracker& self) {
        return "<ceres_ed.Tracker with a map of " + std::to_string(self.NumPoints()) + " points>";
      });
}

void BindTrackerClass(py::module_& module) {
  py::class_<Tracker> tracker(
      module,
      "Tracker",
      R"(Tracks camera and tissue in depth frames, and builds a map of the tissue.

Lengths are in metres. The frame of the map is that of the first camera. Only one thread at a
time may use a tracker: a call during a call of another thread raises a RuntimeError.)");
  tracker
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
           R"(Makes a tracker without a map.

The options of TrackerOptions may be given as keywords, which take precedence over `options`.
`energies` and `plugin` are those of fit(). Raises a ValueError for a bad value.)")
      .def("track",
           &Tracker::Track,
           py::arg("depth"),
           py::arg("color") = py::none(),
           py::arg("pose") = py::none(),
           py::kw_only(),
           py::arg("units_per_metre") = py::none(),
           py::arg("number") = py::none(),
           py::arg("catch_up") = false,
           R"(Processes the next frame and returns its FrameReport.

Other Python threads run during the call.

Args:
  depth: (height, width), the depth along the optical axis; 0 or NaN where there is none. Contiguous
    float32 metres are used as they are; anything else is converted.
  color: (height, width, 3) uint8, red, green and blue.
  pose: (4, 4), camera to world, in metres; for camera='given'.
  units_per_metre: the unit of `depth`, for example 1000 for millimetres; required for integers.
  number: the number of the frame; None means the one after the last.
  catch_up: whether the whole map will be requested after this frame.
Raises:
  ValueError: an image has another shape or type, or a pose is not a rigid motion.)");
  BindTrackerMap(&tracker);
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
