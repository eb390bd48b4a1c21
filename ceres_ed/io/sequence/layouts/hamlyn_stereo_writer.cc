// Writes rectified stereo with the settings of NR-SLAM: two folders of pictures.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>
#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {
namespace {

class HamlynStereoWriter : public LayoutWriter {
 public:
  HamlynStereoWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    Status status = WriteColorImage(Path(NumberedName("left/", number, ".png")), *frame.color);
    return status.ok() ? WriteColorImage(Path(NumberedName("right/", number, ".png")), *frame.right)
                       : status;
  }

  Status WriteCalibration() override {
    const PinholeCamera& camera = options().camera.camera;
    const double baseline = options().rig->right_from_left.translation.norm();
    constexpr double kMillimetresPerMetre = 1000.0;
    std::string text = "%YAML:1.0\n\n";
    for (const auto& [name, value] :
         {std::pair("fx", camera.fx),
          std::pair("fy", camera.fy),
          std::pair("cx", camera.cx),
          std::pair("cy", camera.cy),
          std::pair("bf", camera.fx * baseline * kMillimetresPerMetre)}) {
      text += std::string("Camera.") + name + ": ";
      AppendNumbers({value}, &text);
      text += "\n";
    }
    Status status = WriteText("settings.yaml", text);
    return status.ok() ? WritePosesFile(Path("poses.txt"), FramePoses()) : status;
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateHamlynStereoWriter(
    const std::string& directory, const SequenceWriterOptions& options) {
  return CreateLayoutWriter<HamlynStereoWriter>(directory, options);
}

}  // namespace ceres_ed
