// Writes STIR: one clip with a video for each camera.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>

#include <cmath>

namespace ceres_ed {
namespace {

class StirWriter : public LayoutWriter {
 public:
  StirWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int /*number*/, const FrameToWrite& frame) override {
    Status status = AddToVideo("left/seq00/frames/0ms-1000ms.mp4", *frame.color);
    return status.ok() ? AddToVideo("right/seq00/frames/0ms-1000ms.mp4", *frame.right) : status;
  }

  Status WriteCalibration() override {
    const StereoRig& rig = *options().rig;
    Status status = WritePosesFile(Path("poses.txt"), FramePoses());
    if (status.ok() && !marks().empty()) status = WriteMarks("icgstartseg.png", marks().front());
    if (status.ok() && !marks().empty()) status = WriteMarks("icgendseg.png", marks().back());
    if (!status.ok()) return status;
    const auto lens = [](const LensCamera& camera) {
      return JsonMatrix(Eigen::Map<const Eigen::Matrix<double, 1, 5>>(camera.distortion.data()));
    };
    return WriteText(
        "calib.json",
        "{\"leftcameramat\": " + JsonMatrix(CameraMatrixOf(rig.left.pinhole)) +
            ",\n\"rightcameramat\": " + JsonMatrix(CameraMatrixOf(rig.right.pinhole)) +
            ",\n\"leftdistortioncoeffs\": " + lens(rig.left) +
            ",\n\"rightdistortioncoeffs\": " + lens(rig.right) +
            ",\n\"rotation\": " + JsonMatrix(rig.right_from_left.rotation.toRotationMatrix()) +
            ",\n\"translation\": " + JsonMatrix(rig.right_from_left.translation.transpose()) +
            "}\n");
  }

 private:
  // Writes squares of 5 x 5 pixels around the visible points.
  Status WriteMarks(const std::string& name, const std::vector<MarkedPoint>& points) const {
    const PinholeCamera& camera = options().camera.camera;
    MaskImage mask(camera.width, camera.height, 0);
    for (const MarkedPoint& point : points) {
      if (!point.visible) continue;
      const int u = static_cast<int>(std::lround(point.pixel.x()));
      const int v = static_cast<int>(std::lround(point.pixel.y()));
      for (int dv = -2; dv <= 2; ++dv) {
        for (int du = -2; du <= 2; ++du) mask(u + du, v + dv) = 1;
      }
    }
    return WriteColorImage(Path("left/seq00/segmentation/" + name),
                           MaskPicture(mask, /*white_is_left_out=*/false));
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateStirWriter(const std::string& directory,
                                                           const SequenceWriterOptions& options) {
  return CreateLayoutWriter<StirWriter>(directory, options);
}

}  // namespace ceres_ed
