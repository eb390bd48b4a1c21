// What the folder of a depth sequence holds, without its pictures.
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
  // What the user calls it; ascending in a listing.
  int number = 0;
  // Seconds; ascending in a listing.
  double time_s = 0.0;
  std::string depth_path;
  // Empty where there is none.
  std::string color_path;
  std::string mask_path;
  // Metres.
  std::optional<CameraPose> world_from_camera;
};

// What a format finds in a folder.
struct SequenceListing {
  // With the size of the pictures and the format's unit of depth.
  CameraFile camera;
  // By ascending number.
  std::vector<SequenceEntry> entries;
  // Whether poses, colours, masks are expected of every frame: one without deserves a warning.
  bool has_poses = false;
  bool has_color = false;
  bool has_masks = false;
  // Sentences about the folder as a whole.
  std::vector<std::string> warnings;
};

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_SEQUENCE_LISTING_H_
