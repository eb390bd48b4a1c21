// Writes D4D: a clip with rectified pictures, depth in metres and the poses of both ends.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>
#include <ceres_ed/io/text_rows.h>

namespace ceres_ed {
namespace {

class D4dWriter : public LayoutWriter {
 public:
  D4dWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    Status status =
        WriteColorImage(Path(NumberedName("left_images_rect/", number, ".png")), *frame.color);
    if (status.ok()) {
      status =
          WriteColorImage(Path(NumberedName("right_images_rect/", number, ".png")), *frame.right);
    }
    if (!status.ok() || frame.depth == nullptr) return status;
    NpyArray depth;
    depth.shape = {static_cast<std::size_t>(frame.depth->height()),
                   static_cast<std::size_t>(frame.depth->width())};
    depth.values.assign(frame.depth->pixels().begin(), frame.depth->pixels().end());
    return WriteNpyFileAsFloat(Path(NumberedName("stereo_depth/", number, ".npy")), depth);
  }

  Status WriteCalibration() override {
    const StereoRig& rig = *options().rig;
    const double shift = rig.right_from_left.translation.x() * rig.right.pinhole.fx;
    Status status = WriteText("camera_info/left_rect.yaml", CameraInfo(rig.left.pinhole, 0.0));
    if (status.ok()) {
      status = WriteText("camera_info/right_rect.yaml", CameraInfo(rig.right.pinhole, shift));
    }
    if (status.ok()) status = WritePose("start", poses().front());
    if (status.ok()) status = WritePose("end", poses().back());
    return status.ok() ? WritePosesFile(Path("poses.txt"), FramePoses()) : status;
  }

 private:
  Status WritePose(const std::string& end, const CameraPose& pose) const {
    const Eigen::Matrix4d matrix = MatrixOfPose(pose, 1.0);
    std::string text;
    for (int row = 0; row < 4; ++row) {
      AppendNumbers({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)}, &text);
      text += "\n";
    }
    return WriteText("curated_camera_pose_" + end + ".txt", text);
  }

  static std::string CameraInfo(const PinholeCamera& camera, double shift) {
    std::string numbers;
    for (const double number :
         {camera.fx, 0.0, camera.cx, shift, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0}) {
      if (!numbers.empty()) numbers += ", ";
      AppendNumbers({number}, &numbers);
    }
    return "image_width: " + std::to_string(camera.width) +
           "\nimage_height: " + std::to_string(camera.height) +
           "\nprojection_matrix:\n  rows: 3\n  cols: 4\n  data: [" + numbers + "]\n";
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateD4dWriter(const std::string& directory,
                                                          const SequenceWriterOptions& options) {
  return CreateLayoutWriter<D4dWriter>(directory, options);
}

}  // namespace ceres_ed
