// 7-Scenes: frame-NNNNNN.depth.png, frame-NNNNNN.color.png and frame-NNNNNN.pose.txt in one folder.
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;
// The intrinsics that the web page of the data set names.
constexpr PinholeCamera kNominal = {585.0, 585.0, 320.0, 240.0, 640, 480};

Status SetCamera(const std::string& directory, SequenceListing* listing) {
  listing->camera.depth_units_per_metre = kMillimetresPerMetre;
  const StatusOr<bool> is_given = UseCameraFile(directory, &listing->camera.camera);
  if (!is_given.ok()) return is_given.status();
  if (*is_given) return Status::Ok();
  const StatusOr<std::pair<int, int>> size = ReadPictureSize(listing->entries.front().depth.path);
  if (!size.ok()) return size.status();
  StereoCalibration nominal;
  nominal.rig.left.pinhole = nominal.rig.right.pinhole = kNominal;
  Status status = FitCalibration(directory, size->first, size->second, &nominal);
  if (!status.ok()) return status;
  listing->camera.camera = nominal.rig.left.pinhole;
  listing->warnings.push_back(directory +
                              ": the intrinsics are the nominal ones of 7-Scenes, 585 585 320 240 "
                              "at 640 x 480 (camera.txt in this folder gives others)");
  return Status::Ok();
}

}  // namespace

bool IsSevenScenes(const std::string& directory) {
  return !FilesByNumber(directory, ".depth.png").empty();
}

StatusOr<SequenceListing> ListSevenScenes(const std::string& directory) {
  const std::map<int, std::string> depths = FilesByNumber(directory, ".depth.png");
  if (depths.empty()) {
    return Status::Error(directory + ": no depth, expected frame-NNNNNN.depth.png");
  }
  const std::map<int, std::string> colors = FilesByNumber(directory, ".color.png");
  const std::map<int, std::string> poses = FilesByNumber(directory, ".pose.txt");
  SequenceListing listing;
  for (const auto& [number, path] : depths) {
    SequenceEntry entry;
    entry.number = number;
    entry.time_s = number;
    entry.depth.path = path;
    const auto color = colors.find(number);
    if (color != colors.end()) entry.color.path = color->second;
    const auto file = poses.find(number);
    if (file != poses.end()) {
      const StatusOr<CameraPose> pose = ReadPoseMatrix(file->second, 1.0);
      if (!pose.ok()) return pose.status();
      entry.world_from_camera = *pose;
    }
    listing.entries.push_back(std::move(entry));
  }
  listing.has_color = !colors.empty();
  listing.has_poses = !poses.empty();
  Status status = SetCamera(directory, &listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
