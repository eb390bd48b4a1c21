// Binds sequences of frames, in every layout that ed_slam reads.
#include <ceres_ed/python/arrays.h>
#include <ceres_ed/python/bindings.h>
#include <ceres_ed/python/errors.h>
#include <ceres_ed/python/options.h>
#include <ceres_ed/stereo/depth_source.h>

#include <memory>
#include <utility>

#include <pybind11/stl.h>

namespace ceres_ed::python {
namespace {

// A frame in memory, with its pose.
struct Frame {
  DepthFrame frame;
  py::object pose = py::none();
};

// Returns an array that shows an image of numbers; None if it is empty.
template <typename Pixel>
py::object ImageArray(Image<Pixel>& image, const py::object& owner) {
  if (image.empty()) return py::none();
  return View(image.pixels().data(),
              static_cast<std::size_t>(image.height()),
              static_cast<std::size_t>(image.width()),
              owner);
}

py::object ColorArray(ColorImage& image, const py::object& owner) {
  if (image.empty()) return py::none();
  auto* const first = reinterpret_cast<std::uint8_t*>(image.pixels().data());
  return py::array_t<std::uint8_t>({image.height(), image.width(), 3}, first, owner);
}

py::object PoseOf(const DepthSource& source, int index) {
  const CameraPose* const pose = source.given_pose(index);
  if (pose == nullptr) return py::none();
  Similarity similarity;
  similarity.rotation = pose->rotation;
  similarity.translation = pose->translation;
  return ToMatrix(similarity);
}

std::unique_ptr<Frame> LoadFrame(const DepthSource& source, py::ssize_t given) {
  const py::ssize_t count = source.num_frames();
  const py::ssize_t index = given < 0 ? given + count : given;
  if (index < 0 || index >= count) {
    throw py::index_error("frame " + std::to_string(given) + " of " + std::to_string(count));
  }
  const auto load = [&] {
    const py::gil_scoped_release release;
    return source.Load(static_cast<int>(index));
  };
  auto frame = std::make_unique<Frame>();
  frame->frame = ValueOrThrow(load());
  frame->pose = PoseOf(source, static_cast<int>(index));
  return frame;
}

// Goes from frame to frame.
struct FrameIterator {
  std::shared_ptr<const DepthSource> source;
  int next = 0;
};

std::shared_ptr<DepthSource> Open(const py::object& path_object,
                                  const SequenceOptions* options,
                                  const py::kwargs& changes) {
  SequenceOptions changed = options != nullptr ? *options : SequenceOptions();
  OptionsClass<SequenceOptions>::Apply("open_sequence", changes, &changed);
  const std::string path = ToPath(path_object);
  const auto open = [&] {
    const py::gil_scoped_release release;
    return OpenDepthSource(path, changed, StereoOptions());
  };
  return ValueOrThrow(open());
}

void BindFrame(py::module_& module) {
  py::class_<Frame>(module, "Frame", R"(A frame of a sequence.

Arrays are views of its memory. Tracker.track() takes them as they are:
`tracker.track(frame.depth, frame.color, frame.pose)`.)")
      .def_property_readonly(
          "number", [](const Frame& self) { return self.frame.number; }, "The number of the frame.")
      .def_property_readonly(
          "time",
          [](const Frame& self) { return self.frame.time_s; },
          "The time in seconds; the number of the frame if the frame rate is not known.")
      .def_property_readonly(
          "depth",
          [](const py::object& self) { return ImageArray(self.cast<Frame&>().frame.depth, self); },
          "The depth along the optical axis in metres, (height, width) float32; 0 where there is "
          "none. Pixels that the mask leaves out are 0, too.")
      .def_property_readonly(
          "color",
          [](const py::object& self) { return ColorArray(self.cast<Frame&>().frame.color, self); },
          "Red, green and blue, (height, width, 3) uint8. None without colour.")
      .def_property_readonly(
          "pose",
          [](const Frame& self) { return self.pose; },
          "The true pose of the camera, (4, 4) camera to world, in metres; None without one.")
      .def_property_readonly(
          "warning",
          [](const Frame& self) { return self.frame.warning; },
          "The reason why `color` is None although there is a file; otherwise empty.")
      .def("__repr__", [](const Frame& self) {
        return "<ceres_ed.Frame " + std::to_string(self.frame.number) + ", " +
               std::to_string(self.frame.depth.width()) + " x " +
               std::to_string(self.frame.depth.height()) + ">";
      });
}

}  // namespace

void BindSequence(py::module_& module) {
  const OptionsClass<SequenceOptions> options(
      module, "SequenceOptions", R"(Which frames of a sequence are read, and how.

Each option is an attribute, and a keyword of this class and of open_sequence(). It has the name of
the flag of ed_slam.)");
  BindFrame(module);
  py::class_<FrameIterator>(module, "FrameIterator", "Goes through the frames of a FrameSequence.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__",
           [](FrameIterator& self) {
             if (self.next >= self.source->num_frames()) throw py::stop_iteration();
             return LoadFrame(*self.source, self.next++);
           })
      .def("__repr__", [](const FrameIterator& self) {
        return "<ceres_ed.FrameIterator at " + std::to_string(self.next) + ">";
      });
  py::class_<DepthSource, std::shared_ptr<DepthSource>>(
      module, "FrameSequence", R"(The frames of a folder or a video.

`for frame in sequence` and `sequence[i]` read one frame after the other. Stereo pictures are
rectified and compared; their frames have depth, too. Several threads may read at once.)")
      .def("__len__", &DepthSource::num_frames)
      .def("__getitem__", &LoadFrame, py::arg("index"), R"(Reads frame `index`, counted from 0.

Raises an IndexError beyond the last frame, and a ValueError if its files can't be used.)")
      .def("__iter__",
           [](const std::shared_ptr<DepthSource>& self) {
             return FrameIterator{self, 0};
           })
      .def_property_readonly(
          "camera",
          [](const DepthSource& self) { return self.camera(); },
          "The Camera of the depth.")
      .def_property_readonly(
          "numbers",
          [](const DepthSource& self) {
            std::vector<int> numbers;
            numbers.reserve(self.num_frames());
            for (int i = 0; i < self.num_frames(); ++i) numbers.push_back(self.frame_number(i));
            return numbers;
          },
          "The numbers of the frames, ascending.")
      .def_property_readonly("is_stereo", &DepthSource::is_stereo)
      .def_property_readonly("has_color", &DepthSource::has_color)
      .def_property_readonly("description",
                             &DepthSource::description,
                             "One line: the layout, how it was recognised, and what there is.")
      .def_property_readonly(
          "warnings", &DepthSource::warnings, "Sentences about what is missing or assumed.")
      .def("__repr__", [](const DepthSource& self) {
        return "<ceres_ed.FrameSequence of " + std::to_string(self.num_frames()) +
               " frames: " + self.description() + ">";
      });
  module.def("open_sequence",
             &Open,
             py::arg("path"),
             py::arg("options") = nullptr,
             R"(Opens a FrameSequence: a folder of depth images or stereo pictures, or a video.

All layouts of ed_slam are recognised. The options of SequenceOptions may be given as keywords,
which take precedence over `options`. Raises a ValueError that names the path and what was expected
if it is no such folder.)");
}

}  // namespace ceres_ed::python
