// Writes SuPer: left pictures, depth in metres, and camera.txt, which the data set lacks.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>

#include <limits>

namespace ceres_ed {
namespace {

class SuperWriter : public LayoutWriter {
 public:
  SuperWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    NpyArray depth;
    depth.shape = {static_cast<std::size_t>(frame.depth->height()),
                   static_cast<std::size_t>(frame.depth->width())};
    depth.values.assign(frame.depth->pixels().begin(), frame.depth->pixels().end());
    Status status = WriteNpyFileAsFloat(Path(NumberedName("depth/", number, "-left.npy")), depth);
    if (!status.ok()) return status;
    const ColorImage grey(frame.depth->width(), frame.depth->height(), {128, 128, 128});
    const bool has_color = frame.color != nullptr && !frame.color->empty();
    return WriteColorImage(Path(NumberedName("rgb/", number, "-left.png")),
                           has_color ? *frame.color : grey);
  }

  Status WriteCalibration() override {
    Status status = WriteCameraFile(Path("camera.txt"), {options().camera.camera, 1.0});
    if (status.ok()) status = WritePosesFile(Path("poses.txt"), FramePoses());
    if (!status.ok() || marks().empty()) return status;
    NpyArray points;
    points.shape = {marks().size(), marks().front().size(), 2};
    for (const std::vector<MarkedPoint>& of_frame : marks()) {
      for (const MarkedPoint& mark : of_frame) {
        constexpr double kHidden = std::numeric_limits<double>::quiet_NaN();
        points.values.push_back(mark.visible ? mark.pixel.x() : kHidden);
        points.values.push_back(mark.visible ? mark.pixel.y() : kHidden);
      }
    }
    return WriteNpyFile(Path("rgb/left_pts.npy"), points);
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateSuperWriter(const std::string& directory,
                                                            const SequenceWriterOptions& options) {
  return CreateLayoutWriter<SuperWriter>(directory, options);
}

}  // namespace ceres_ed
