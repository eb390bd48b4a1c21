// Depth sequences with truth in the native layout: color/ depth/ mask/ camera.txt poses.txt
// gt_mesh_000000.ply gt_vertices.f32.
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
  // Intrinsics, and the unit of the depth that is stored.
  CameraFile camera;
  // Faces of the true surface; empty where its vertices are not known.
  std::vector<std::array<int, 3>> truth_triangles;
  // Whether a sequence that is in the folder already may be deleted: its text files, truth and
  // numbered pictures, and nothing else.
  bool overwrite = false;
};

// A frame to write. The pictures have the camera's size.
struct NativeFrame {
  // Metres; 0 where there is none. Must be there.
  const DepthImage* depth = nullptr;
  // Not written where null or empty.
  const ColorImage* color = nullptr;
  const MaskImage* mask = nullptr;
  CameraPose world_from_camera;
  // The true surface's vertices, world frame, metres; null where they are not known. The same
  // number in every frame, and in all of them or in none.
  const std::vector<Eigen::Vector3d>* truth = nullptr;
};

// Writes frames 000000, 000001 ... as they come. camera.txt and the pictures stand as soon as they
// are written, each of them whole; poses and truth when Finish() returns, and not at all if it is
// never called. Memory does not grow with the frames but for a pose each.
class NativeSequenceWriter {
 public:
  // Returns the writer with its folders made (parents too). Errors: `directory` is a file, holds a
  // sequence and `overwrite` is false, or can't be written; intrinsics that WriteCameraFile
  // refuses.
  static StatusOr<std::unique_ptr<NativeSequenceWriter>> Create(
      const std::string& directory, const NativeSequenceOptions& options);

  // Returns ok when the frame's pictures are on disk; else an error with the system's reason.
  Status WriteFrame(const NativeFrame& frame);

  // Writes poses.txt, gt_mesh_000000.ply and gt_vertices.f32 for the frames that there are. To be
  // called once at most.
  Status Finish();

  int num_frames() const { return static_cast<int>(poses_.size()); }

 private:
  NativeSequenceWriter(std::string directory, const NativeSequenceOptions& options);
  Status WriteTruth(const std::vector<Eigen::Vector3d>& points);

  std::string directory_;
  NativeSequenceOptions options_;
  std::vector<FramePose> poses_;
  // Null until there is a first frame with truth.
  std::unique_ptr<SceneTruthWriter> truth_;
};

// Returns true if `directory` holds a part of a sequence in the native layout.
bool HoldsNativeSequence(const std::string& directory);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_NATIVE_WRITER_H_
