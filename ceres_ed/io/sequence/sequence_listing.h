// The contents of the folder of a depth sequence, without its images.
#ifndef CERES_ED_IO_SEQUENCE_SEQUENCE_LISTING_H_
#define CERES_ED_IO_SEQUENCE_SEQUENCE_LISTING_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/camera_io.h>

#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// The files of one frame.
struct SequenceEntry {
  // The number of the frame for the user; ascending in a listing.
  int number = 0;
  // The time in seconds; ascending in a listing.
  double time_s = 0.0;
  std::string depth_path;
  // Empty if there is none.
  std::string color_path;
  std::string mask_path;
  // Metres.
  std::optional<CameraPose> world_from_camera;
};

// The frames of a folder, as found by a format.
struct SequenceListing {
  // The intrinsics, with the size of the images and the format's unit of depth.
  CameraFile camera;
  // The frames by ascending number.
  std::vector<SequenceEntry> entries;
  // Whether every frame is expected to have a pose, colour, a mask. A frame without it gives a
  // warning.
  bool has_poses = false;
  bool has_color = false;
  bool has_masks = false;
  // Sentences about the folder as a whole.
  std::vector<std::string> warnings;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_SEQUENCE_LISTING_H_
