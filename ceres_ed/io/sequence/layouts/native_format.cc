#include "ceres_ed/io/sequence/sequence_format.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_listing.h>

namespace ceres_ed {
bool IsNativeSequence(const std::string& directory) {
  return IsFile(JoinPath(directory, "camera.txt"));
}

StatusOr<SequenceListing> ListNativeSequence(const std::string& directory) {
  const StatusOr<CameraFile> camera = ReadCameraFile(JoinPath(directory, "camera.txt"));
  if (!camera.ok()) return camera.status();
  PictureFolders folders;
  folders.depth = JoinPath(directory, "depth");
  folders.color = JoinPath(directory, "color");
  folders.mask = JoinPath(directory, "mask");
  StatusOr<SequenceListing> listing = ListPictureFolders(folders);
  if (!listing.ok()) return listing.status();
  listing->camera = *camera;
  Status status = AddPosesFile(JoinPath(directory, "poses.txt"), &*listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
