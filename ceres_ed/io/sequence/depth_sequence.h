// A folder of depth pictures of one camera, frame by frame.
//
// Three layouts are known (what a format needs is marked *):
//
// native  *camera.txt              fx fy cx cy width height depth_units_per_metre
//         *depth/NNNNNN.png        16 bits, 0 = no depth
//          color/NNNNNN.png|jpg
//          mask/NNNNNN.png|jpg     zero pixels are left out
//          poses.txt               frame tx ty tz qx qy qz qw, camera to world, metres
// tum     *depth.txt               timestamp filename (as the TUM RGB-D benchmark has it)
//          rgb.txt                 timestamp filename
//          groundtruth.txt         timestamp tx ty tz qx qy qz qw, camera to world, metres
//          camera.txt              as in native; without it, TUM's intrinsics of freiburg1, 2 or 3
//                                  where the folder's name says so, or else those of a plain Kinect
//                                  (525 525 319.5 239.5) and a warning; 5000 units per metre
// hamlyn  *intrinsics.txt          3 rows of 3 or 4 numbers, the rectified camera matrix
//         *depth/ or depth01/      *.png, 16 bits, millimetres
//          color/ or image01/      *.png|jpg
//          mask/                   *.png|jpg
//
// Numbers of native and hamlyn are the digits that end a file's name, padded or not; they may leave
// gaps. Frames of tum are numbered from 0 in the order of time; colour belongs to the depth next to
// it in time, one to one, and poses are the nearest, both within 0.02 s.
#ifndef CERES_ED_IO_SEQUENCE_DEPTH_SEQUENCE_H_
#define CERES_ED_IO_SEQUENCE_DEPTH_SEQUENCE_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/options_fwd.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace ceres_ed {

struct SequenceEntry;
struct SequenceListing;

// The layout of a folder.
enum class SequenceFormat { kAuto, kNative, kTum, kHamlyn };

constexpr std::array<NamedValue<SequenceFormat>, 4> NamesOf(SequenceFormat) {
  return {{{"auto", SequenceFormat::kAuto},
           {"tum", SequenceFormat::kTum},
           {"native", SequenceFormat::kNative},
           {"hamlyn", SequenceFormat::kHamlyn}}};
}

// Which frames to read, and how.
struct SequenceOptions {
  // kAuto guesses from the files that are there.
  SequenceFormat format = SequenceFormat::kAuto;
  // Frame number; >= 0. Frames ahead of it are left out.
  int first = 0;
  // Frame number, not below `first`; frames behind it are left out. -1: up to the end.
  int last = -1;
  // Every step-th of the frames that are there, from the first one; >= 1.
  int step = 1;
  // False leaves colour aside even where there is some.
  bool color = true;
  // False leaves masks aside: all depth that was measured counts.
  bool masks = true;
  // Stored depth / this = metres; 0: what the sequence says. >= 0.
  double depth_units_per_metre = 0.0;

  // False, with the value and what was expected in `error`, unless every option is in its range.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<SequenceOptions>& Rows();
};

// A frame in memory.
struct DepthFrame {
  int number = 0;
  // Seconds, as DepthSequence::time_s().
  double time_s = 0.0;
  // Metres, of the camera's size; 0 where nothing was measured or the mask says no.
  DepthImage depth;
  // Of the same size, or empty.
  ColorImage color;
  // Why `color` is empty although the sequence has a file for it; else empty.
  std::string warning;
};

// Why a frame can't be had.
enum class FrameProblem {
  kNone,
  // A file is missing, damaged or of another kind. Others may be fine: skip this frame.
  kUnreadable,
  // Depth, mask or colour has another size than the camera: the calibration is not of this
  // sequence, go no further.
  kWrongSize,
};

// The frames of a folder, as OpenSequence() selected them. Pictures are read one by one, on demand.
class DepthSequence {
 public:
  // Frames of `listing` as they stand, at least one. `description` is for a user to read.
  DepthSequence(SequenceListing listing, std::string description);
  ~DepthSequence();
  DepthSequence(const DepthSequence&) = delete;
  DepthSequence& operator=(const DepthSequence&) = delete;

  const PinholeCamera& camera() const;
  // Stored depth / this = metres.
  double depth_units_per_metre() const;

  int num_frames() const;
  // The number that the sequence gives to frame 0 <= i < num_frames(); ascending.
  int frame_number(int i) const;
  // When frame i was taken, seconds: its time stamp (tum), or its number where the rate is unknown
  // (native, hamlyn). Not descending.
  double time_s(int i) const;
  // The true world_from_camera of frame i, metres; null where the sequence has none.
  const CameraPose* given_pose(int i) const;
  // Whether at least one frame has colour.
  bool has_color() const;

  // One line: the format and how it was guessed, frames, size, unit, what else is there.
  const std::string& description() const { return description_; }
  // Sentences about what is missing: gaps, frames without colour, mask or pose, intrinsics assumed.
  const std::vector<std::string>& warnings() const;

  // Returns frame i with its mask applied, or an error that names the file; then `problem`, if not
  // null, tells whether the caller can go on without this frame. A missing or damaged colour
  // picture is no error: the frame comes without.
  StatusOr<DepthFrame> Load(int i, FrameProblem* problem = nullptr) const;

 private:
  const SequenceEntry& entry(int i) const;
  // Ok when a picture of `path` has the camera's size.
  Status CheckSize(const std::string& path, int width, int height) const;
  Status LoadDepth(const SequenceEntry& entry, DepthImage* depth, FrameProblem* problem) const;
  Status LoadColor(const SequenceEntry& entry, DepthFrame* frame, FrameProblem* problem) const;

  std::unique_ptr<const SequenceListing> listing_;
  std::string description_;
};

// Returns the frames of `directory` that `options` select, without reading their pictures (but for
// the size of one, where nothing else tells it). The same files give the same sequence, whatever
// order the file system lists them in. Errors name the path, the value and what was expected: no
// such folder, no layout that is known, no depth, intrinsics or poses that can't be used, two files
// for one frame, options out of range, no frames left.
StatusOr<std::unique_ptr<DepthSequence>> OpenSequence(const std::string& directory,
                                                      const SequenceOptions& options = {});

// Returns a sentence when the median of the measured depth is nearer than 1 mm or farther than
// 100 m, as it is when the unit of depth is off by 1000; else, or without any depth, nothing.
// `depth` is in metres; `depth_units_per_metre` is what it was read with, for the sentence.
std::string DepthRangeWarning(const DepthImage& depth, double depth_units_per_metre);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_DEPTH_SEQUENCE_H_
