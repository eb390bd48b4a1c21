// Writes sequences with ground truth in the native layout: color/ depth/ camera.txt, or left/
// right/ stereo.txt, and mask/ poses.txt gt_mesh_000000.ply gt_vertices.f32.
#ifndef CERES_ED_IO_SEQUENCE_NATIVE_WRITER_H_
#define CERES_ED_IO_SEQUENCE_NATIVE_WRITER_H_

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/io/sequence/sequence_writer.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Writes frames 000000, 000001 and so on, or with the numbers that they are given. camera.txt and
// each image are complete files as soon as they are written. Poses and ground truth are complete
// when Close() returns; without Close() they are not written. The memory that is needed grows by
// one pose for each frame only.
class NativeSequenceWriter : public SequenceWriter {
 public:
  // Creates the folder (with its parents) and returns the writer. Returns an error if `directory`
  // is a file, contains a sequence and `overwrite` is false, or can't be written, and for
  // intrinsics that WriteCameraFile() refuses.
  static StatusOr<std::unique_ptr<NativeSequenceWriter>> Create(
      const std::string& directory, const SequenceWriterOptions& options);

  // Writes the images of the next frame. The error gives the system's reason.
  Status WriteFrame(const FrameToWrite& frame) override;

  // Writes poses.txt, gt_mesh_000000.ply and gt_vertices.f32 for all frames so far. Call it at most
  // once.
  Status Close() override;

  int num_frames() const override { return num_frames_; }

 private:
  NativeSequenceWriter(std::string directory, const SequenceWriterOptions& options);
  Status WriteTruth(const std::vector<Eigen::Vector3d>& points);

  std::string directory_;
  SequenceWriterOptions options_;
  std::vector<FramePose> poses_;
  int num_frames_ = 0;
  int last_number_ = -1;
  // Null before the first frame with ground truth.
  std::unique_ptr<SceneTruthWriter> truth_;
};

// Returns whether `directory` contains a part of a sequence in the native layout.
bool HoldsNativeSequence(const std::string& directory);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_NATIVE_WRITER_H_
