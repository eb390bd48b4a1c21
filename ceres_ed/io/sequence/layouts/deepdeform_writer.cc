// Writes DeepDeform: depth in millimetres, and intrinsics.txt of 4 x 4 numbers.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>
#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {
namespace {

class DeepDeformWriter : public LayoutWriter {
 public:
  DeepDeformWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    constexpr double kMillimetresPerMetre = 1000.0;
    Status status = WriteDepthImage(
        Path(NumberedName("depth/", number, ".png")), *frame.depth, kMillimetresPerMetre);
    if (!status.ok() || frame.color == nullptr || frame.color->empty()) return status;
    return WriteColorImage(Path(NumberedName("color/", number, ".png")), *frame.color);
  }

  Status WriteCalibration() override {
    const PinholeCamera& camera = options().camera.camera;
    std::string text;
    AppendNumbers({camera.fx, 0.0, camera.cx, 0.0}, &text);
    text += "\n";
    AppendNumbers({0.0, camera.fy, camera.cy, 0.0}, &text);
    Status status = WriteText("intrinsics.txt", text + "\n0 0 1 0\n0 0 0 1\n");
    return status.ok() ? WritePosesFile(Path("poses.txt"), FramePoses()) : status;
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateDeepDeformWriter(
    const std::string& directory, const SequenceWriterOptions& options) {
  return CreateLayoutWriter<DeepDeformWriter>(directory, options);
}

}  // namespace ceres_ed
