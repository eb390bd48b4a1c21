// Writes SurgT: a video with the left picture above the right one, and info.yaml.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>
#include <ceres_ed/io/sequence/layouts/surgt_truth.h>

#include <algorithm>
#include <cstddef>

namespace ceres_ed {
namespace {

class SurgTWriter : public LayoutWriter {
 public:
  SurgTWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int /*number*/, const FrameToWrite& frame) override {
    return AddToVideo("video.mp4", Stacked(*frame.color, *frame.right));
  }

  Status WriteCalibration() override {
    const PinholeCamera& camera = options().camera.camera;
    Status status = WriteText("calibration.yaml", OpenCvCalibrationText(*options().rig));
    if (!status.ok()) return status;
    status = WritePosesFile(Path("poses.txt"), FramePoses());
    if (!status.ok()) return status;
    const std::size_t num_tracks =
        marks().empty() ? 0 : std::min<std::size_t>(3, marks().front().size());
    std::string names;
    for (std::size_t i = 0; i < num_tracks; ++i) {
      const std::string name = "gt_rectified_" + std::to_string(i) + ".yaml";
      status = WriteText(name, BoxTrackText(Boxes(i), num_frames()));
      if (!status.ok()) return status;
      names += "\n- " + name;
    }
    return WriteText(
        "info.yaml",
        "name_ground_truth:" + (names.empty() ? " []" : names) +
            "\nname_video: video.mp4\nresolution:\n  height: " + std::to_string(camera.height) +
            "\n  width: " + std::to_string(camera.width) + "\nvideo_stack: vertical\n");
  }

 private:
  // Returns boxes of 20 x 20 pixels around a marked point, in both pictures.
  BoxTrack Boxes(std::size_t point) const {
    constexpr double kSize = 20.0;
    const StereoRig& rig = *options().rig;
    const double focal_times_baseline =
        rig.left.pinhole.fx * rig.right_from_left.translation.norm();
    BoxTrack track;
    for (std::size_t frame = 0; frame < marks().size(); ++frame) {
      const MarkedPoint& mark = marks()[frame][point];
      if (!mark.visible) continue;
      StereoBox box;
      box.left = {mark.pixel.x() - kSize / 2, mark.pixel.y() - kSize / 2, kSize, kSize};
      box.right = box.left;
      box.right.u -= focal_times_baseline / mark.depth;
      track.boxes[static_cast<int>(frame)] = box;
    }
    return track;
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateSurgTWriter(const std::string& directory,
                                                            const SequenceWriterOptions& options) {
  return CreateLayoutWriter<SurgTWriter>(directory, options);
}

}  // namespace ceres_ed
