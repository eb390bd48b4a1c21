#include "ceres_ed/io/sequence/sequence_format.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/layouts/stereo_file.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_listing.h>

namespace ceres_ed {

bool IsNativeStereoSequence(const std::string& directory) {
  return IsFile(JoinPath(directory, "stereo.txt"));
}

StatusOr<SequenceListing> ListNativeStereoSequence(const std::string& directory) {
  StatusOr<StereoRig> rig = ReadStereoFile(JoinPath(directory, "stereo.txt"));
  if (!rig.ok()) return rig.status();
  PictureFolders folders;
  folders.color = JoinPath(directory, "left");
  folders.right = JoinPath(directory, "right");
  folders.mask = JoinPath(directory, "mask");
  // Depth that was measured otherwise may lie beside the pictures.
  const std::string camera_path = JoinPath(directory, "camera.txt");
  folders.depth = JoinPath(directory, "depth");
  const bool has_depth = IsFile(camera_path) && IsFolder(folders.depth);
  if (!has_depth) folders.depth.clear();
  StatusOr<SequenceListing> listing = ListStereoFolders(folders);
  if (!listing.ok()) return listing.status();
  listing->rig = *rig;
  listing->is_rectified = true;
  listing->camera.camera = rig->left.pinhole;
  if (has_depth) {
    const StatusOr<CameraFile> camera = ReadCameraFile(camera_path);
    if (!camera.ok()) return camera.status();
    listing->camera = *camera;
  }
  Status status = AddPosesFile(JoinPath(directory, "poses.txt"), &*listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
