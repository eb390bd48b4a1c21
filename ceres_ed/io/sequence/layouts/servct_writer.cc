// Writes SERV-CT: rectified pairs with depth.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>

namespace ceres_ed {
namespace {

class ServCtWriter : public LayoutWriter {
 public:
  ServCtWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/1) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    const std::string name = NumberedName("", number, ".png").substr(3);
    Status status = WriteColorImage(Path("Left_rectified/" + name), *frame.color);
    if (status.ok()) status = WriteColorImage(Path("Right_rectified/" + name), *frame.right);
    if (!status.ok() || frame.depth == nullptr) return status;
    constexpr double kUnitsPerMetre = 256000.0;
    return WriteDepthImage(Path("Ground_truth_CT/DepthL/" + name), *frame.depth, kUnitsPerMetre);
  }

  Status WriteCalibration() override {
    const StereoRig& rig = *options().rig;
    Eigen::Matrix<double, 3, 4> left = Eigen::Matrix<double, 3, 4>::Zero();
    left.leftCols<3>() = CameraMatrixOf(rig.left.pinhole);
    Eigen::Matrix<double, 3, 4> right = left;
    right.leftCols<3>() = CameraMatrixOf(rig.right.pinhole);
    constexpr double kMillimetresPerMetre = 1000.0;
    right(0, 3) = rig.right_from_left.translation.x() * kMillimetresPerMetre * rig.right.pinhole.fx;
    const std::string text =
        "{\"P1\": " + JsonMatrix(left) + ",\n\"P2\": " + JsonMatrix(right) + "}\n";
    Status status = WritePosesFile(Path("poses.txt"), FramePoses());
    for (int i = 0; status.ok() && i < num_frames(); ++i) {
      const std::string name = NumberedName("", first_number() + i, ".json").substr(3);
      status = WriteText("Rectified_calibration/" + name, text);
    }
    return status;
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateServCtWriter(const std::string& directory,
                                                             const SequenceWriterOptions& options) {
  return CreateLayoutWriter<ServCtWriter>(directory, options);
}

}  // namespace ceres_ed
