// Reads a folder of depth images of one camera, or of the pictures of a stereo camera, frame by
// frame.
//
// These are the layouts (required files are marked *):
//
//   native  *camera.txt              fx fy cx cy width height depth_units_per_metre
//           *depth/NNNNNN.png        16 bits, 0 = no depth
//            color/NNNNNN.png|jpg
//            mask/NNNNNN.png|jpg     zero pixels are left out
//            poses.txt               frame tx ty tz qx qy qz qw, camera to world, metres
//   tum     *depth.txt               timestamp filename (as in the TUM RGB-D benchmark)
//            rgb.txt                 timestamp filename
//            groundtruth.txt         timestamp tx ty tz qx qy qz qw, camera to world, metres
//            camera.txt              as in native; without it, TUM's intrinsics of freiburg1, 2 or
//                                    3 if the folder's name contains one of them, otherwise those
//                                    of a plain Kinect (525 525 319.5 239.5) and a warning; 5000
//                                    units per metre
//   hamlyn  *intrinsics.txt          3 rows of 3 or 4 numbers, the rectified camera matrix
//           *depth/ or depth01/      *.png, 16 bits, millimetres
//            color/ or image01/      *.png|jpg
//            mask/                   *.png|jpg
//   native_stereo
//           *stereo.txt              fx fy cx_left cx_right cy width height baseline_metres
//           *left/, right/           NNNNNN.png|jpg, rectified
//            mask/, poses.txt        as in native, of the left camera
//            camera.txt, depth/      as in native, if depth was measured too
//   scikit_surgery
//           *calib.left.intrinsic.txt, calib.right.intrinsic.txt
//                                    3 rows of 3 numbers, pixels
//            calib.left.distortion.txt, calib.right.distortion.txt
//                                    k1 k2 p1 p2 [k3 ...] as OpenCV has them
//           *calib.l2r.txt           4 rows of 4 numbers: right from left, millimetres; or
//                                    calib.r2l.txt, its inverse
//           *left/, right/           NNNNNN.png|jpg, as the cameras give them
//            mask/, poses.txt        as in native, of the left camera
//
// In all but tum, the number of a frame is given by the digits at the end of a
// file's name, padded or not. There may be gaps. In tum, frames are numbered from 0 in the order of
// time. Each colour image belongs to the depth image nearest in time, one to one, and the pose is
// the nearest one, both within 0.02 s.
#ifndef CERES_ED_IO_SEQUENCE_DEPTH_SEQUENCE_H_
#define CERES_ED_IO_SEQUENCE_DEPTH_SEQUENCE_H_

#include <ceres_ed/geometry/depth_noise.h>
#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

struct SequenceEntry;
struct SequenceListing;

// The layout of a folder.
enum class SequenceFormat {
  kAuto,
  kNative,
  kTum,
  kHamlyn,
  kNativeStereo,
  kScikitSurgery,
  kStereoVideo,
  kStereoMis,
  kScared,
  kEndoNerf,
  kDeform3dgs,
  kD4d,
  kServCt,
  kSurgT,
  kStir,
  kHamlynStereo,
  kC3vd,
  kDeepDeform,
  kSuper,
  kSevenScenes
};

constexpr std::array<NamedValue<SequenceFormat>, 20> NamesOf(SequenceFormat) {
  return {{{"auto", SequenceFormat::kAuto},
           {"tum", SequenceFormat::kTum},
           {"native", SequenceFormat::kNative},
           {"hamlyn", SequenceFormat::kHamlyn},
           {"native_stereo", SequenceFormat::kNativeStereo},
           {"scikit_surgery", SequenceFormat::kScikitSurgery},
           {"stereo_video", SequenceFormat::kStereoVideo},
           {"stereomis", SequenceFormat::kStereoMis},
           {"scared", SequenceFormat::kScared},
           {"endonerf", SequenceFormat::kEndoNerf},
           {"deform3dgs", SequenceFormat::kDeform3dgs},
           {"d4d", SequenceFormat::kD4d},
           {"servct", SequenceFormat::kServCt},
           {"surgt", SequenceFormat::kSurgT},
           {"stir", SequenceFormat::kStir},
           {"hamlyn_stereo", SequenceFormat::kHamlynStereo},
           {"c3vd", SequenceFormat::kC3vd},
           {"deepdeform", SequenceFormat::kDeepDeform},
           {"super", SequenceFormat::kSuper},
           {"sevenscenes", SequenceFormat::kSevenScenes}}};
}

// Where the depth of a frame comes from. A sequence may have both images of depth and the pictures
// of two cameras.
enum class DepthFrom {
  // The images of depth if there are any, otherwise the two pictures.
  kAuto,
  kImages,
  kStereo,
};

constexpr std::array<NamedValue<DepthFrom>, 3> NamesOf(DepthFrom) {
  return {
      {{"auto", DepthFrom::kAuto}, {"images", DepthFrom::kImages}, {"stereo", DepthFrom::kStereo}}};
}

// What white pixels of a mask mean.
enum class MaskMeans {
  // As the layout has it; if it does not say, by the share of the picture that is white.
  kAuto,
  kTool,
  kTissue,
};

constexpr std::array<NamedValue<MaskMeans>, 3> NamesOf(MaskMeans) {
  return {{{"auto", MaskMeans::kAuto}, {"tool", MaskMeans::kTool}, {"tissue", MaskMeans::kTissue}}};
}

// Options for the frames to read.
struct SequenceOptions {
  // The layout. kAuto recognises it from the files in the folder.
  SequenceFormat format = SequenceFormat::kAuto;
  // The number of the first frame, >= 0. Frames before it are left out.
  int first = 0;
  // The number of the last frame, not below `first`. Frames after it are left out. -1: all frames
  // up to the end.
  int last = -1;
  // Read every step-th of the existing frames, beginning with the first one; >= 1.
  int step = 1;
  // Where depth comes from.
  DepthFrom depth_from = DepthFrom::kAuto;
  // If false, colour is not read even if there is some, except for stereo, which needs it.
  bool color = true;
  // If false, masks are not applied: all measured depth is used.
  bool masks = true;
  // What white (nonzero) pixels of a mask are. A tool is left out.
  MaskMeans mask_means = MaskMeans::kAuto;
  // The number of stored depth units in a metre, >= 0 (metres = stored depth / this). 0: as given
  // by the sequence.
  double depth_units_per_metre = 0.0;

  // Returns true if every option is in its range. Otherwise returns false and writes to `error` the
  // value and what was expected.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<SequenceOptions>& Rows();
};

// A frame in memory.
struct DepthFrame {
  int number = 0;
  // The time in seconds, as DepthSequence::time_s().
  double time_s = 0.0;
  // The depth in metres, of the camera's size; 0 where nothing was measured or the mask is zero.
  // Empty in a stereo sequence, whose depth is found by comparing the pictures.
  DepthImage depth;
  // How uncertain the depth is, in metres; unknown for images of depth.
  DepthNoise noise;
  // Of stereo pictures: the seconds that comparing them took, and the share of the pixels that
  // count whose depth was found; -1 for images of depth.
  double stereo_s = -1.0;
  double valid_share = -1.0;
  // The number of pixels whose depth was the largest number of the file, 65535: they are left out.
  int saturated = 0;
  // The colour image of the same size, or empty. In a stereo sequence, the left picture.
  ColorImage color;
  // In a stereo sequence, the right picture and the mask of the left one; the mask is empty if all
  // pixels count. Empty in other sequences.
  ColorImage right;
  MaskImage mask;
  // The reason why `color` is empty although the sequence has a file for it; otherwise empty.
  std::string warning;
};

// The reason why a frame can't be read.
enum class FrameProblem {
  kNone,
  // A file is missing, damaged or of another kind. Other frames may be valid: skip this frame.
  kUnreadable,
  // Depth, mask or a picture has another size than the camera. The calibration does not belong to
  // this sequence: stop here.
  kWrongSize,
};

// The frames of a folder that OpenSequence() has selected. Images are read one by one, on demand.
class DepthSequence {
 public:
  // Takes all frames of `listing`, at least one. `description` is a text for the user.
  DepthSequence(SequenceListing listing, std::string description);
  ~DepthSequence();
  DepthSequence(const DepthSequence&) = delete;
  DepthSequence& operator=(const DepthSequence&) = delete;

  const PinholeCamera& camera() const;
  // The number of stored depth units in a metre (metres = stored depth / this). It means nothing in
  // a stereo sequence.
  double depth_units_per_metre() const;
  // Returns the two cameras if this is a stereo sequence, whose frames have a left and a right
  // picture and no depth; otherwise null.
  const StereoRig* rig() const;
  // Returns whether the pictures of a stereo sequence are said to be rectified.
  bool is_rectified() const;

  int num_frames() const;
  // The number of frame i in the sequence, 0 <= i < num_frames(). Numbers are ascending.
  int frame_number(int i) const;
  // The time of frame i in seconds: its time stamp (tum), or its number if the frame rate is
  // unknown (native, hamlyn). Times never decrease.
  double time_s(int i) const;
  // Returns the true world_from_camera of frame i, in metres; null if the sequence has none.
  const CameraPose* given_pose(int i) const;
  // Returns whether at least one frame has colour.
  bool has_color() const;

  // A description in one line: the format and how it was recognised, frames, size, unit, and what
  // else there is.
  const std::string& description() const { return description_; }
  // Sentences about missing parts: gaps, frames without colour, mask or pose, assumed intrinsics.
  const std::vector<std::string>& warnings() const;

  // Reads frame i and, unless it is a stereo sequence, applies its mask to the depth. The error
  // names the file; if `problem` is not null, it then says whether the caller can continue without
  // this frame. A missing or damaged colour image is not an error: the frame has no colour.
  StatusOr<DepthFrame> Load(int i, FrameProblem* problem = nullptr) const;

  // Reads only the colour picture of frame i, the left one of a stereo sequence, as it is in the
  // file. It is empty if the frame has none, or if it cannot be read.
  ColorImage LoadPicture(int i) const;

 private:
  const SequenceEntry& entry(int i) const;
  Status LoadDepth(const SequenceEntry& entry, DepthFrame* frame, FrameProblem* problem) const;
  Status LoadPair(const SequenceEntry& entry, DepthFrame* frame, FrameProblem* problem) const;
  Status LoadColor(const SequenceEntry& entry, DepthFrame* frame, FrameProblem* problem) const;

  std::unique_ptr<const SequenceListing> listing_;
  std::string description_;
};

// Opens the frames of `directory` that `options` select. Images are not read yet (except for the
// size of one, if no other file gives it). The same files give the same sequence, whatever order
// the file system lists them in. Errors name the path, the value and what was expected: there is no
// such folder, no known layout, or no depth; intrinsics or poses are not valid; two files have the
// same frame; options are out of range; or no frames are left.
StatusOr<std::unique_ptr<DepthSequence>> OpenSequence(const std::string& directory,
                                                      const SequenceOptions& options = {});

// Returns a sentence if the unit of depth seems to be wrong: the median of the measured depth is
// less than 1 mm or more than 100 m, or all depths are whole numbers of units of more than 2 cm
// (a body 80 mm away whose millimetres are read as metres). The sentence names the unit that would
// place the scene at 2 cm to 10 m, if there is one. Otherwise, or if there is no depth, returns an
// empty string. `depth` is in metres. `depth_units_per_metre` is the number with which it was read.
std::string DepthRangeWarning(const DepthImage& depth, double depth_units_per_metre);

// Returns a sentence about such a median of depth that was found with two cameras that are
// `baseline` metres apart.
std::string StereoRangeWarning(const DepthImage& depth, double baseline);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_DEPTH_SEQUENCE_H_
