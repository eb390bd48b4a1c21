#include "ceres_ed/io/sequence/sequence_format.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_listing.h>

#include <cstddef>
#include <map>

namespace ceres_ed {
namespace {

Status AddPoses(const std::string& path, SequenceListing* listing) {
  const StatusOr<std::vector<FramePose>> poses = ReadPosesFile(path);
  if (!poses.ok()) return poses.status();
  std::map<int, const CameraPose*> pose_of_frame;
  for (const FramePose& pose : *poses) pose_of_frame[pose.frame] = &pose.world_from_camera;
  for (SequenceEntry& entry : listing->entries) {
    const auto pose = pose_of_frame.find(entry.number);
    if (pose != pose_of_frame.end()) entry.world_from_camera = *pose->second;
  }
  listing->has_poses = true;
  return Status::Ok();
}

}  // namespace

StatusOr<SequenceListing> ListNativeSequence(const std::string& directory) {
  const StatusOr<CameraFile> camera = ReadCameraFile(JoinPath(directory, "camera.txt"));
  if (!camera.ok()) return camera.status();
  StatusOr<SequenceListing> listing = ListPictureFolders(
      {JoinPath(directory, "depth"), JoinPath(directory, "color"), JoinPath(directory, "mask")});
  if (!listing.ok()) return listing.status();
  listing->camera = *camera;
  const std::string poses_path = JoinPath(directory, "poses.txt");
  if (IsFile(poses_path)) {
    Status status = AddPoses(poses_path, &*listing);
    if (!status.ok()) return status;
  }
  return listing;
}

}  // namespace ceres_ed
