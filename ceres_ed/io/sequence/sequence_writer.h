// Writes sequences, in any of the layouts that can be written. To add one, write a class that is
// derived from SequenceWriter with a function that makes it, and add a declaration and a row of the
// table here.
#ifndef CERES_ED_IO_SEQUENCE_SEQUENCE_WRITER_H_
#define CERES_ED_IO_SEQUENCE_SEQUENCE_WRITER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

struct SequenceWriterOptions {
  // The intrinsics, and the unit of the stored depth.
  CameraFile camera;
  // The two cameras of a stereo sequence, which is written without depth. `camera` is the left one.
  std::optional<StereoRig> rig;
  // The triangles of the true surface; empty if its vertices are not known.
  std::vector<std::array<int, 3>> truth_triangles;
  // Whether an existing sequence in the folder may be deleted. Only its text files, ground truth
  // and numbered images are deleted.
  bool overwrite = false;
};

// A frame to write. The images have the camera's size.
struct FrameToWrite {
  // The depth in metres; 0 where there is none. Required unless there is a rig; with a rig, a
  // layout may write it as truth.
  const DepthImage* depth = nullptr;
  // The colour picture; with a rig, the left one, and required. Not written if null or empty.
  const ColorImage* color = nullptr;
  // The picture of the right camera; required with a rig.
  const ColorImage* right = nullptr;
  // Not written if null or empty.
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

// Writes frame by frame. The errors give the system's reason.
class SequenceWriter {
 public:
  virtual ~SequenceWriter() = default;

  // Writes the next frame.
  virtual Status WriteFrame(const FrameToWrite& frame) = 0;
  // Completes what belongs to all frames, such as poses and truth. Call it at most once.
  virtual Status Close() = 0;
  // Returns the number of frames so far.
  virtual int num_frames() const = 0;
};

// A layout that can be written.
struct SequenceLayout {
  SequenceFormat format = SequenceFormat::kAuto;
  // Whether it is for stereo pictures (and needs a rig) or for depth.
  bool is_stereo = false;
  // Creates the folder and a writer, or returns an error: the folder holds a sequence already and
  // `overwrite` is false, or it can't be written.
  StatusOr<std::unique_ptr<SequenceWriter>> (*create)(
      const std::string& directory, const SequenceWriterOptions& options) = nullptr;
};

// The native layout: depth without a rig, stereo with one.
StatusOr<std::unique_ptr<SequenceWriter>> CreateNativeWriter(const std::string& directory,
                                                             const SequenceWriterOptions& options);

// The layouts of data sets, each in a file of its own.
StatusOr<std::unique_ptr<SequenceWriter>> CreateStereoMisWriter(
    const std::string& directory, const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateScaredWriter(const std::string& directory,
                                                             const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateSurgTWriter(const std::string& directory,
                                                            const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateStirWriter(const std::string& directory,
                                                           const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateHamlynStereoWriter(
    const std::string& directory, const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateServCtWriter(const std::string& directory,
                                                             const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateD4dWriter(const std::string& directory,
                                                          const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateEndoNerfWriter(
    const std::string& directory, const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateDeform3dgsWriter(
    const std::string& directory, const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateC3vdWriter(const std::string& directory,
                                                           const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateDeepDeformWriter(
    const std::string& directory, const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateSuperWriter(const std::string& directory,
                                                            const SequenceWriterOptions& options);
StatusOr<std::unique_ptr<SequenceWriter>> CreateSevenScenesWriter(
    const std::string& directory, const SequenceWriterOptions& options);

inline constexpr SequenceLayout kSequenceLayouts[] = {
    {SequenceFormat::kNative, false, CreateNativeWriter},
    {SequenceFormat::kNativeStereo, true, CreateNativeWriter},
    {SequenceFormat::kStereoMis, true, CreateStereoMisWriter},
    {SequenceFormat::kScared, true, CreateScaredWriter},
    {SequenceFormat::kSurgT, true, CreateSurgTWriter},
    {SequenceFormat::kStir, true, CreateStirWriter},
    {SequenceFormat::kHamlynStereo, true, CreateHamlynStereoWriter},
    {SequenceFormat::kServCt, true, CreateServCtWriter},
    {SequenceFormat::kD4d, true, CreateD4dWriter},
    {SequenceFormat::kEndoNerf, false, CreateEndoNerfWriter},
    {SequenceFormat::kDeform3dgs, false, CreateDeform3dgsWriter},
    {SequenceFormat::kC3vd, false, CreateC3vdWriter},
    {SequenceFormat::kDeepDeform, false, CreateDeepDeformWriter},
    {SequenceFormat::kSuper, false, CreateSuperWriter},
    {SequenceFormat::kSevenScenes, false, CreateSevenScenesWriter}};

// Returns the layout of that name, for kAuto the native one; null if it can't be written, or not
// for stereo pictures (or for depth, by `is_stereo`).
const SequenceLayout* FindSequenceLayout(SequenceFormat format, bool is_stereo);

// Returns the names of the layouts that can be written, with `separator` between them.
std::string ListSequenceLayouts(bool is_stereo, const char* separator);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_SEQUENCE_WRITER_H_
