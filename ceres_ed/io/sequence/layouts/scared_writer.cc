// Writes SCARED: the keyframe with its depth, the video that begins there, and the poses.
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>

namespace ceres_ed {
namespace {

class ScaredWriter : public LayoutWriter {
 public:
  ScaredWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    Status status = AddToVideo("data/rgb.mp4", Stacked(*frame.color, *frame.right));
    if (!status.ok() || number > 0) return status;
    status = WriteColorImage(Path("Left_Image.png"), *frame.color);
    if (status.ok()) status = WriteColorImage(Path("Right_Image.png"), *frame.right);
    if (!status.ok() || frame.depth == nullptr) return status;
    return WritePointImage(
        Path("left_depth_map.tiff"), options().camera.camera, *frame.depth, kMillimetresPerMetre);
  }

  Status WriteCalibration() override {
    Status status = WriteText("endoscope_calibration.yaml", OpenCvCalibrationText(*options().rig));
    for (std::size_t i = 0; status.ok() && i < poses().size(); ++i) {
      status = WriteText(NumberedName("data/frame_data/frame_data", static_cast<int>(i), ".json"),
                         "{\"camera-pose\": " +
                             JsonMatrix(MatrixOfPose(poses()[i], kMillimetresPerMetre)) + "}\n");
    }
    return status;
  }

 private:
  static constexpr double kMillimetresPerMetre = 1000.0;
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateScaredWriter(const std::string& directory,
                                                             const SequenceWriterOptions& options) {
  return CreateLayoutWriter<ScaredWriter>(directory, options);
}

}  // namespace ceres_ed
