#include "ceres_ed/python/tracker.h"

#include <ceres_ed/pipeline/slam/map_export.h>
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/energies.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/memory.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace ceres_ed::python {

Tracker::Tracker(const PinholeCamera& camera,
                 const SlamOptions* options,
                 const py::object& energies,
                 const py::object& plugin,
                 const py::kwargs& changes)
    : camera_(camera), energies_(ToEnergies(energies, plugin)) {
  SlamOptions changed = options != nullptr ? *options : SlamOptions();
  OptionsClass<SlamOptions>::Apply("Tracker", changes, &changed);
  changed.levels.energies = energies_.specs;
  ExpectLargeBlocks();
  camera_is_given_ = changed.camera == CameraMode::kGiven;
  slam_ = ValueOrThrow(DeformableSlam::Create(camera, changed, energies_.registry));
}

void Tracker::CheckSize(const py::array& image, const char* what) const {
  if (image.ndim() >= 2 && image.shape(0) == camera_.height && image.shape(1) == camera_.width) {
    return;
  }
  throw py::value_error(std::string(what) + " has shape " +
                        std::string(py::str(image.attr("shape"))) + ", expected the camera's (" +
                        std::to_string(camera_.height) + ", " + std::to_string(camera_.width) +
                        (what == std::string("depth") ? ")" : ", 3)"));
}

// Returns the array itself if it has contiguous float32 metres, otherwise a converted copy.
py::array_t<float, py::array::c_style> Tracker::Metres(
    const py::object& object, std::optional<double> units_per_metre) const {
  py::array depth = py::array::ensure(object);
  if (!depth) throw py::value_error("depth: expected an array");
  CheckSize(depth, "depth");
  if (depth.ndim() != 2) throw py::value_error("depth: expected (height, width)");
  const char kind = depth.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::value_error("depth is an array of " + std::string(py::str(depth.dtype())) +
                          ", expected floats or integers");
  }
  if (kind != 'f' && !units_per_metre) {
    throw py::value_error(
        "depth is an array of integers, expected units_per_metre, too "
        "(1000 for millimetres)");
  }
  if (units_per_metre && !(*units_per_metre > 0.0 && std::isfinite(*units_per_metre))) {
    throw py::value_error("units_per_metre is " + std::to_string(*units_per_metre) +
                          ", expected > 0");
  }
  if (units_per_metre && *units_per_metre != 1.0) {
    // The division is done in double and rounded once, as when sequences are read.
    depth = Doubles(depth, "depth").attr("__truediv__")(*units_per_metre);
  }
  return py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(depth);
}

FrameReport Tracker::Track(const py::object& depth_object,
                           const py::object& color_object,
                           const py::object& pose_object,
                           std::optional<double> units_per_metre,
                           std::optional<int> number,
                           bool catch_up) {
  using Rgb = std::array<std::uint8_t, 3>;
  SlamFrame frame;
  frame.number = number.value_or(next_number_);
  frame.catch_up = catch_up;
  const auto depth = Metres(depth_object, units_per_metre);
  frame.depth = {depth.data(), camera_.width, camera_.height};
  py::array_t<std::uint8_t, py::array::c_style> color;
  if (!color_object.is_none()) {
    const py::array given = py::array::ensure(color_object);
    if (!given || given.dtype().kind() != 'u' || given.itemsize() != 1 || given.ndim() != 3 ||
        given.shape(2) != 3) {
      throw py::value_error("color: expected (height, width, 3) uint8, red green blue");
    }
    CheckSize(given, "color");
    color = py::array_t<std::uint8_t, py::array::c_style>::ensure(given);
    frame.color = {reinterpret_cast<const Rgb*>(color.data()), camera_.width, camera_.height};
  }
  ceres_ed::CameraPose world_from_camera;
  if (!pose_object.is_none()) {
    const Similarity pose = ToSimilarity(pose_object, "pose", /*with_scale=*/false);
    world_from_camera.rotation = pose.rotation;
    world_from_camera.translation = pose.translation;
    frame.world_from_camera = &world_from_camera;
  } else if (camera_is_given_) {
    throw py::value_error(
        "pose is None, expected (4, 4): camera='given' needs the pose of every frame");
  }
  const Turn turn(&busy_);
  next_number_ = frame.number + 1;
  const auto process = [&] {
    const py::gil_scoped_release release;
    return slam_->Process(frame);
  };
  FrameReport report = process();
  energies_.errors->Rethrow();
  return report;
}

void Tracker::CatchUp() {
  const auto catch_up = [&] {
    const py::gil_scoped_release release;
    slam_->CatchUp();
  };
  catch_up();
  energies_.errors->Rethrow();
}

MapSnapshot Tracker::Snapshot(const std::string& frame) {
  if (frame != "map" && frame != "camera") {
    throw py::value_error("frame is '" + frame + "', expected 'map' or 'camera'");
  }
  const Turn turn(&busy_);
  CatchUp();
  const py::gil_scoped_release release;
  return ExportMap(*slam_, frame == "camera" ? MapFrame::kCamera : MapFrame::kMap);
}

Warp Tracker::MakeWarp() {
  const Turn turn(&busy_);
  CatchUp();
  return ExportWarp(*slam_);
}

std::optional<Similarity> Tracker::CameraPose() const {
  const Turn turn(&busy_);
  if (slam_->unit() == 0.0) return std::nullopt;
  const ceres_ed::CameraPose map_from_camera = ExportCameraPose(*slam_);
  Similarity pose;
  pose.rotation = map_from_camera.rotation;
  pose.translation = map_from_camera.translation;
  return pose;
}

int Tracker::NumPoints() const {
  const Turn turn(&busy_);
  return slam_->map().num_points();
}

py::array Tracker::PointRelevant() const {
  const Turn turn(&busy_);
  py::array_t<bool> flags(slam_->map().graph().num_nodes());
  for (int j = 0; j < flags.size(); ++j) flags.mutable_at(j) = slam_->HasData(j);
  return ReadOnly(std::move(flags));
}

}  // namespace ceres_ed::python
