// The contents of the folder of a sequence, without its images.
#ifndef CERES_ED_IO_SEQUENCE_SEQUENCE_LISTING_H_
#define CERES_ED_IO_SEQUENCE_SEQUENCE_LISTING_H_

#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/picture_source.h>

#include <optional>
#include <string>
#include <vector>

namespace ceres_ed {

// The pictures of one frame. Each is empty if there is none.
struct SequenceEntry {
  // The number of the frame for the user; ascending in a listing.
  int number = 0;
  // The time in seconds; ascending in a listing.
  double time_s = 0.0;
  PictureSource depth;
  // The picture of the camera whose depth is known: of a stereo camera, the left one.
  PictureSource color;
  // The picture of the right camera.
  PictureSource right;
  // The mask of `depth` or of the left picture.
  PictureSource mask;
  // The pose of the camera of `color`, as its picture is (before a rectification). Metres.
  std::optional<CameraPose> world_from_camera;
};

// The frames of a folder, as found by a format.
struct SequenceListing {
  // The intrinsics of the camera of `color`, with the size of the images and the format's unit of
  // depth. They are those of rig->left.pinhole if there is a rig and no depth.
  CameraFile camera;
  MaskMeaning mask_meaning = MaskMeaning::kUsed;
  // The two cameras of a stereo sequence. Nothing if the pictures `right` can't be used.
  std::optional<StereoRig> rig;
  // Whether the format says that the pictures are rectified: the rig then has no distortion and no
  // rotation, its translation is (-baseline, 0, 0), and both cameras have the same fx, fy and cy.
  bool is_rectified = false;
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
