// Writes StereoMIS: a video with the left picture above the right one.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>
#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {
namespace {

class StereoMisWriter : public LayoutWriter {
 public:
  StereoMisWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/1) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    Status status = AddToVideo("recording.mp4", Stacked(*frame.color, *frame.right));
    if (status.ok() && frame.mask != nullptr && !frame.mask->empty()) {
      status = WriteColorImage(Path(NumberedName("masks/", number, "l.png")),
                               MaskPicture(*frame.mask, /*white_is_left_out=*/false));
    }
    return status;
  }

  Status WriteCalibration() override {
    const StereoRig& rig = *options().rig;
    std::string text = Section("StereoLeft", rig.left) + Section("StereoRight", rig.right);
    const Eigen::Matrix3d rotation = rig.right_from_left.rotation.toRotationMatrix();
    for (int i = 0; i < 9; ++i) {
      text += "R_" + std::to_string(i) + "=" + Text(rotation(i / 3, i % 3)) + "\n";
    }
    for (int i = 0; i < 3; ++i) {
      text += "T_" + std::to_string(i) + "=" + Text(rig.right_from_left.translation[i]) + "\n";
    }
    Status status = WriteText("StereoCalibration.ini", text);
    if (!status.ok()) return status;
    // Row by row from frame 1 on.
    std::vector<TimedPose> rows;
    for (const CameraPose& pose : poses()) {
      rows.push_back({static_cast<double>(rows.size() + 1), pose});
    }
    return WriteTrajectory(Path("groundtruth.txt"), rows);
  }

 private:
  static std::string Text(double number) {
    std::string text;
    AppendNumbers({number}, &text);
    return text;
  }

  static std::string Section(const std::string& name, const LensCamera& camera) {
    const PinholeCamera& pinhole = camera.pinhole;
    std::string text = "[" + name + "]\nres_x=" + std::to_string(pinhole.width) +
                       "\nres_y=" + std::to_string(pinhole.height) + "\nfc_x=" + Text(pinhole.fx) +
                       "\nfc_y=" + Text(pinhole.fy) + "\ncc_x=" + Text(pinhole.cx) +
                       "\ncc_y=" + Text(pinhole.cy) + "\n";
    for (std::size_t i = 0; i < camera.distortion.size(); ++i) {
      text += "kc_" + std::to_string(i) + "=" + Text(camera.distortion[i]) + "\n";
    }
    return text;
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateStereoMisWriter(
    const std::string& directory, const SequenceWriterOptions& options) {
  return CreateLayoutWriter<StereoMisWriter>(directory, options);
}

}  // namespace ceres_ed
