// Writes C3VD: depth of 16 bits over 100 mm, and poses column by column.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>
#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {
namespace {

class C3vdWriter : public LayoutWriter {
 public:
  C3vdWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    constexpr double kUnitsPerMetre = 655350.0;
    Status status = WriteDepthImage(
        Path(NumberedName("", number, "_depth.tiff").substr(2)), *frame.depth, kUnitsPerMetre);
    if (!status.ok() || frame.color == nullptr || frame.color->empty()) return status;
    return WriteColorImage(Path(std::to_string(number) + "_color.png"), *frame.color);
  }

  Status WriteCalibration() override {
    constexpr double kMillimetresPerMetre = 1000.0;
    std::string text;
    for (const CameraPose& pose : poses()) {
      const Eigen::Matrix4d matrix = MatrixOfPose(pose, kMillimetresPerMetre);
      for (int i = 0; i < 16; ++i) {
        if (i > 0) text += ",";
        AppendNumbers({matrix(i % 4, i / 4)}, &text);
      }
      text += "\n";
    }
    Status status = WriteText("pose.txt", text);
    if (!status.ok()) return status;
    constexpr double kUnitsPerMetre = 655350.0;
    return WriteCameraFile(Path("camera.txt"), {options().camera.camera, kUnitsPerMetre});
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateC3vdWriter(const std::string& directory,
                                                           const SequenceWriterOptions& options) {
  return CreateLayoutWriter<C3vdWriter>(directory, options);
}

}  // namespace ceres_ed
