// The annotation of SurgT: a box around a piece of tissue in each frame.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_SURGT_TRUTH_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_SURGT_TRUTH_H_

#include <ceres_ed/util/status.h>

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A box in a picture, in pixels.
struct PictureBox {
  // The upper left corner.
  double u = 0.0;
  double v = 0.0;
  double width = 0.0;
  double height = 0.0;

  Eigen::Vector2d center() const { return {u + width / 2, v + height / 2}; }
};

// The box of a frame in the rectified pictures of both cameras.
struct StereoBox {
  PictureBox left;
  PictureBox right;
  // Frames that are hard to annotate do not count in the challenge.
  bool is_difficult = false;
};

// The boxes of one piece of tissue.
struct BoxTrack {
  // The name of the file.
  std::string name;
  // The boxes by frame; a frame without one is not there.
  std::map<int, StereoBox> boxes;
};

// Reads gt_rectified_*.yaml of a folder, sorted by name; there may be none. Each has, for each
// frame from 0 on, [visible, difficult, [[u, v, width, height] of the left, ... of the right
// picture] or null], as a list or with the frames as keys. The error names file and frame.
StatusOr<std::vector<BoxTrack>> ReadSurgTBoxes(const std::string& directory);

// Returns a file of that form for the frames 0 to num_frames - 1.
std::string BoxTrackText(const BoxTrack& track, int num_frames);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_SURGT_TRUTH_H_
