// The base of the writers of layouts of data sets.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_LAYOUT_WRITER_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_LAYOUT_WRITER_H_

#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/io/sequence/sequence_writer.h>
#include <ceres_ed/io/video/video_module.h>
#include <ceres_ed/util/status.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

// Where a marked piece of the tissue is in a frame.
struct MarkedPoint {
  // In the picture of the (left) camera.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // Along the optical axis, in metres.
  double depth = 0.0;
  bool visible = false;
};

// Keeps what is the same in all layouts: the folder, the poses, and the true surface, which has
// names of its own (scene_truth.h) and lies beside the files of the data set. A layout derives from
// it and writes its pictures, and its calibration and poses at the end.
class LayoutWriter : public SequenceWriter {
 public:
  Status WriteFrame(const FrameToWrite& frame) override;
  Status Close() override;
  int num_frames() const override { return static_cast<int>(poses_.size()); }

 protected:
  // Frames are numbered from `first_number` on.
  LayoutWriter(std::string directory, const SequenceWriterOptions& options, int first_number);

  // Writes the pictures of a frame.
  virtual Status WritePictures(int number, const FrameToWrite& frame) = 0;
  // Writes calibration and poses.
  virtual Status WriteCalibration() = 0;

  const SequenceWriterOptions& options() const { return options_; }
  // The number of the first frame, and the poses from there on.
  int first_number() const { return first_number_; }
  const std::vector<CameraPose>& poses() const { return poses_; }
  // The poses with the numbers of their frames, for poses.txt, which counts as truth in every
  // layout.
  std::vector<FramePose> FramePoses() const;

  // The places of up to a dozen vertices of the truth that are visible in the first frame, for each
  // frame; empty without truth. Some data sets have such points as their truth.
  const std::vector<std::vector<MarkedPoint>>& marks() const { return marks_; }

  // Returns the path of a file of the layout. Its folder is created.
  std::string Path(const std::string& name) const;
  // Writes a text to a file of the layout.
  Status WriteText(const std::string& name, const std::string& text) const;
  // Adds a frame to the video `name`, which the first frame creates.
  Status AddToVideo(const std::string& name, const ColorImage& picture);

  // Returns the picture of both cameras, the left one above the right one.
  static ColorImage Stacked(const ColorImage& left, const ColorImage& right);
  // Returns a mask as a picture. White is what is used, or with `white_is_left_out` the rest.
  static ColorImage MaskPicture(const MaskImage& mask, bool white_is_left_out);

 private:
  struct OpenVideo {
    std::string name;
    std::unique_ptr<VideoEncoder> encoder;
  };

  Status AddTruth(const std::vector<Eigen::Vector3d>& points);
  MarkedPoint MarkOf(const FrameToWrite& frame, const Eigen::Vector3d& in_world) const;
  void AddMarks(const FrameToWrite& frame);

  std::string directory_;
  SequenceWriterOptions options_;
  int first_number_ = 0;
  std::vector<CameraPose> poses_;
  std::unique_ptr<SceneTruthWriter> truth_;
  // The vertices that are marked.
  std::vector<std::size_t> marked_;
  std::vector<std::vector<MarkedPoint>> marks_;
  std::vector<OpenVideo> videos_;
};

// Returns an error unless the folder is empty or may be overwritten.
Status CheckLayoutFolder(const std::string& directory, const SequenceWriterOptions& options);

// Creates a writer of the class Writer.
template <typename Writer>
StatusOr<std::unique_ptr<SequenceWriter>> CreateLayoutWriter(const std::string& directory,
                                                             const SequenceWriterOptions& options) {
  Status status = CheckLayoutFolder(directory, options);
  if (!status.ok()) return status;
  return StatusOr<std::unique_ptr<SequenceWriter>>(std::make_unique<Writer>(directory, options));
}

// Returns a name with six digits: prefix000012suffix.
std::string NumberedName(const std::string& prefix, int number, const std::string& suffix);

// Returns a matrix of numbers in JSON: [[1, 0], [0, 1]].
std::string JsonMatrix(const Eigen::MatrixXd& matrix);

// Returns the camera matrix 3 x 3.
Eigen::Matrix3d CameraMatrixOf(const PinholeCamera& camera);

// Returns M1, D1, M2, D2, R and T as OpenCV writes them, T in millimetres.
std::string OpenCvCalibrationText(const StereoRig& rig);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_LAYOUT_WRITER_H_
