// Writes depth sequences with ground truth in the native layout: color/ depth/ mask/ camera.txt
// poses.txt gt_mesh_000000.ply gt_vertices.f32.
#ifndef CERES_ED_IO_SEQUENCE_NATIVE_WRITER_H_
#define CERES_ED_IO_SEQUENCE_NATIVE_WRITER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/scene_truth.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct NativeSequenceOptions {
  // The intrinsics, and the unit of the stored depth.
  CameraFile camera;
  // The triangles of the true surface; empty if its vertices are not known.
  std::vector<std::array<int, 3>> truth_triangles;
  // Whether an existing sequence in the folder may be deleted. Only its text files, ground truth
  // and numbered images are deleted.
  bool overwrite = false;
};

// A frame to write. The images have the camera's size.
struct NativeFrame {
  // The depth in metres; 0 where there is none. Required.
  const DepthImage* depth = nullptr;
  // Not written if null or empty.
  const ColorImage* color = nullptr;
  const MaskImage* mask = nullptr;
  CameraPose world_from_camera;
  // Whether the pose is known; it is not written if it is not.
  bool has_pose = true;
  // The number of the frame, larger than that of the frame before; -1: one more than that.
  int number = -1;
  // The vertices of the true surface in the world frame, in metres; null if they are not known. All
  // frames have the same number of them, or none has any.
  const std::vector<Eigen::Vector3d>* truth = nullptr;
};

// Writes frames 000000, 000001 and so on, or with the numbers that they are given. camera.txt and
// each image are complete files as soon as they are written. Poses and ground truth are complete
// when Close() returns; without Close() they are not written. The memory that is needed grows by
// one pose for each frame only.
class NativeSequenceWriter {
 public:
  // Creates the folder (with its parents) and returns the writer. Returns an error if `directory`
  // is a file, contains a sequence and `overwrite` is false, or can't be written, and for
  // intrinsics that WriteCameraFile() refuses.
  static StatusOr<std::unique_ptr<NativeSequenceWriter>> Create(
      const std::string& directory, const NativeSequenceOptions& options);

  // Writes the images of the next frame. The error gives the system's reason.
  Status WriteFrame(const NativeFrame& frame);

  // Writes poses.txt, gt_mesh_000000.ply and gt_vertices.f32 for all frames so far. Call it at most
  // once.
  Status Close();

  int num_frames() const { return num_frames_; }

 private:
  NativeSequenceWriter(std::string directory, const NativeSequenceOptions& options);
  Status WriteTruth(const std::vector<Eigen::Vector3d>& points);

  std::string directory_;
  NativeSequenceOptions options_;
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
