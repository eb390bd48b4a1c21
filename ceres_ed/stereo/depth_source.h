// Frames with depth from any sequence: images of depth as they are, stereo pictures compared.
#ifndef CERES_ED_STEREO_DEPTH_SOURCE_H_
#define CERES_ED_STEREO_DEPTH_SOURCE_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/sequence/depth_sequence.h>
#include <ceres_ed/stereo/stereo_matcher.h>
#include <ceres_ed/stereo/stereo_options.h>
#include <ceres_ed/util/status.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// A sequence whose frames all have depth.
class DepthSource {
 public:
  // Takes a sequence. A stereo sequence is checked with its first pair that can be read: it is an
  // error (or a warning, by `options.check`) if left and right are swapped, or if the rows do not
  // correspond (CheckPair()). `name` is the sequence in messages.
  static StatusOr<std::unique_ptr<DepthSource>> Create(std::unique_ptr<DepthSequence> sequence,
                                                       const std::string& name,
                                                       const StereoOptions& options);

  // The pictures as they are in files.
  const DepthSequence& sequence() const { return *sequence_; }
  bool is_stereo() const { return matcher_ != nullptr; }
  // The camera of the depth: of a stereo sequence, the rectified left one.
  const PinholeCamera& camera() const;
  // The rectified cameras of a stereo sequence, otherwise null.
  const RectifiedRig* rig() const;
  int num_frames() const { return sequence_->num_frames(); }
  int frame_number(int i) const { return sequence_->frame_number(i); }
  double time_s(int i) const { return sequence_->time_s(i); }
  bool has_color() const { return sequence_->has_color(); }
  // Returns the true world_from_camera of frame i for that camera, in metres; null if the sequence
  // has none.
  const CameraPose* given_pose(int i) const;

  // A description in one line, and sentences about missing parts and about the pictures.
  std::string description() const;
  const std::vector<std::string>& warnings() const { return warnings_; }

  // Returns frame i as DepthSequence::Load() does. A frame of stereo pictures gets depth, noise and
  // the rectified left picture and its mask; `right` is empty then. The same frame gives
  // the same bytes in any order and at any number of threads.
  StatusOr<DepthFrame> Load(int i, FrameProblem* problem = nullptr) const;
  // The two steps of Load(): decoding, and the comparison of stereo pictures, which takes most of
  // the time. An error is passed on.
  StatusOr<DepthFrame> LoadPictures(int i, FrameProblem* problem = nullptr) const;
  StatusOr<DepthFrame> FindDepth(StatusOr<DepthFrame> pictures) const;

  // Returns only the colour picture of frame i, of a stereo sequence the rectified left one, with
  // the size of the camera. It is empty if there is none.
  ColorImage LoadPicture(int i) const;

 private:
  DepthSource() = default;
  Status CheckFirstPair(const std::string& name, bool refuse);

  std::unique_ptr<DepthSequence> sequence_;
  // Null if the sequence has images of depth.
  std::unique_ptr<StereoMatcher> matcher_;
  // The true poses of the rectified camera, if the pictures are rectified here.
  std::vector<std::optional<CameraPose>> poses_;
  std::vector<std::string> warnings_;
};

// Opens a sequence and makes a source of it.
StatusOr<std::unique_ptr<DepthSource>> OpenDepthSource(const std::string& directory,
                                                       const SequenceOptions& options,
                                                       const StereoOptions& stereo);

}  // namespace ceres_ed

#endif  // CERES_ED_STEREO_DEPTH_SOURCE_H_
