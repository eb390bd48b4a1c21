// Writes SurgT: a video with the left picture above the right one, and info.yaml.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layout_writer.h>

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
    return WriteText("info.yaml",
                     "name_ground_truth: []\nname_video: video.mp4\nresolution:\n  height: " +
                         std::to_string(camera.height) + "\n  width: " +
                         std::to_string(camera.width) + "\nvideo_stack: vertical\n");
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateSurgTWriter(const std::string& directory,
                                                            const SequenceWriterOptions& options) {
  return CreateLayoutWriter<SurgTWriter>(directory, options);
}

}  // namespace ceres_ed
