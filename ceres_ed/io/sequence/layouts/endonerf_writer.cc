// Writes EndoNeRF: depth in whole millimetres, and masks in which white is the tool.
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/sequence/layouts/layout_writer.h>

#include <array>

namespace ceres_ed {
namespace {

class EndoNerfWriter : public LayoutWriter {
 public:
  EndoNerfWriter(const std::string& directory, const SequenceWriterOptions& options)
      : LayoutWriter(directory, options, /*first_number=*/0) {}

 protected:
  Status WritePictures(int number, const FrameToWrite& frame) override {
    Status status = WriteDepthImage(Path(NumberedName("depth/frame-", number, ".depth.png")),
                                    *frame.depth,
                                    kMillimetresPerMetre);
    if (status.ok()) {
      status = WriteColorImage(Path(NumberedName("images/frame-", number, ".color.png")),
                               frame.color->empty() ? Grey() : *frame.color);
    }
    if (!status.ok()) return status;
    const MaskImage all(frame.depth->width(), frame.depth->height(), 1);
    const bool has_mask = frame.mask != nullptr && !frame.mask->empty();
    return WriteColorImage(Path(NumberedName("masks/frame-", number, ".mask.png")),
                           MaskPicture(has_mask ? *frame.mask : all, /*white_is_left_out=*/true));
  }

  Status WriteCalibration() override {
    const PinholeCamera& camera = options().camera.camera;
    NpyArray array;
    constexpr std::size_t kNumbers = 17;
    array.shape = {poses().size(), kNumbers};
    for (std::size_t i = 0; i < poses().size(); ++i) {
      const std::array<double, kNumbers> row = {1,
                                                0,
                                                0,
                                                0,
                                                1.0 * camera.height,
                                                0,
                                                1,
                                                0,
                                                0,
                                                1.0 * camera.width,
                                                0,
                                                0,
                                                1,
                                                0,
                                                camera.fx,
                                                0.01,
                                                1.0};
      array.values.insert(array.values.end(), row.begin(), row.end());
    }
    Status status = WriteNpyFile(Path("poses_bounds.npy"), array);
    return status.ok() ? WritePosesFile(Path("poses.txt"), FramePoses()) : status;
  }

 private:
  static constexpr double kMillimetresPerMetre = 1000.0;

  ColorImage Grey() const {
    const PinholeCamera& camera = options().camera.camera;
    return {camera.width, camera.height, {128, 128, 128}};
  }
};

}  // namespace

StatusOr<std::unique_ptr<SequenceWriter>> CreateEndoNerfWriter(
    const std::string& directory, const SequenceWriterOptions& options) {
  return CreateLayoutWriter<EndoNerfWriter>(directory, options);
}

}  // namespace ceres_ed
