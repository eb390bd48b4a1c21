// Writes 7-Scenes: depth in millimetres with 65535 for none, and a pose a frame.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>
#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {
namespace {

class SevenScenesWriter : public LayoutWriter {
 public:
  SevenScenesWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    constexpr double kMillimetresPerMetre = 1000.0;
    Status status = WriteDepthImage(
        Path(NumberedName("frame-", number, ".depth.png")), *frame.depth, kMillimetresPerMetre);
    if (status.ok() && frame.color != nullptr && !frame.color->empty()) {
      status = WriteColorImage(Path(NumberedName("frame-", number, ".color.png")), *frame.color);
    }
    if (!status.ok()) return status;
    const Eigen::Matrix4d matrix = MatrixOfPose(frame.world_from_camera, 1.0);
    std::string text;
    for (int row = 0; row < 4; ++row) {
      AppendNumbers({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)}, &text);
      text += "\n";
    }
    return WriteText(NumberedName("frame-", number, ".pose.txt"), text);
  }

  Status WriteCalibration() override {
    return WriteCameraFile(Path("camera.txt"), {options().camera.camera, 1000.0});
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateSevenScenesWriter(
    const std::string& directory, const SequenceWriterOptions& options) {
  return CreateLayoutWriter<SevenScenesWriter>(directory, options);
}

}  // namespace ceres_ed
