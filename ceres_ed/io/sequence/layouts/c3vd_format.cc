// C3VD: NNNN_depth.tiff, N_color.png and pose.txt of a colonoscope in a silicone model.
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {
namespace {

// 65535 stands for 100 mm.
constexpr double kUnitsPerMetre = 655350.0;
constexpr double kMillimetresPerMetre = 1000.0;
// The size of the recordings, and a pinhole that fits the middle of the fisheye picture.
constexpr PinholeCamera kNominal = {767.4, 767.5, 679.1, 543.6, 1350, 1080};

std::map<int, std::string> Depths(const std::string& directory) {
  return FilesByNumber(directory, "_depth.tiff");
}

// Sets the nominal camera for pictures of this size.
Status SetCamera(const std::string& directory, SequenceListing* listing) {
  listing->camera.depth_units_per_metre = kUnitsPerMetre;
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
  listing->warnings.push_back(
      directory +
      ": the lens is a fisheye, and the pictures are not rectified; a nominal pinhole "
      "camera is taken, so directions far from the middle of the picture are wrong "
      "(camera.txt in this folder gives another one)");
  return Status::Ok();
}

}  // namespace

bool IsC3vd(const std::string& directory) { return !Depths(directory).empty(); }

StatusOr<SequenceListing> ListC3vd(const std::string& directory) {
  const std::map<int, std::string> depths = Depths(directory);
  if (depths.empty()) {
    return Status::Error(directory + ": no depth, expected NNNN_depth.tiff");
  }
  const std::map<int, std::string> colors = FilesByNumber(directory, "_color.png");
  SequenceListing listing;
  for (const auto& [number, path] : depths) {
    SequenceEntry entry;
    entry.number = number;
    entry.time_s = number;
    entry.depth.path = path;
    const auto color = colors.find(number);
    if (color != colors.end()) entry.color.path = color->second;
    listing.entries.push_back(std::move(entry));
  }
  listing.has_color = !colors.empty();
  Status status = SetCamera(directory, &listing);
  if (!status.ok()) return status;
  const std::string path = JoinPath(directory, "pose.txt");
  if (!IsFile(path)) return listing;
  // Row n is the pose of frame n, camera to world, column by column, in millimetres.
  const auto poses = ReadPoseRows(path, kMillimetresPerMetre, /*by_columns=*/true);
  if (!poses.ok()) return poses.status();
  for (SequenceEntry& entry : listing.entries) {
    const auto row = static_cast<std::size_t>(entry.number);
    if (row < poses->size()) entry.world_from_camera = (*poses)[row];
  }
  listing.has_poses = true;
  return listing;
}

}  // namespace ceres_ed
