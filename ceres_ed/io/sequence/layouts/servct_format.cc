// SERV-CT: rectified stereo pairs of organs at rest, with depth by CT. The pairs are no video.
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {
namespace {

// 256 units per millimetre.
constexpr double kUnitsPerMetre = 256000.0;

std::string ServCtDepth(const std::string& directory) {
  return JoinPath(directory, "Ground_truth_CT/DepthL");
}

}  // namespace

bool IsServCt(const std::string& directory) {
  return IsFolder(JoinPath(directory, "Left_rectified")) &&
         IsFolder(JoinPath(directory, "Right_rectified"));
}

StatusOr<SequenceListing> ListServCt(const std::string& directory) {
  const std::string folder = JoinPath(directory, "Rectified_calibration");
  const std::map<int, std::string> calibrations = FilesByNumber(folder, ".json");
  if (calibrations.empty()) {
    return MissingCalibration(JoinPath(folder, "001.json"), "P1 and P2 in pixels and millimetres");
  }
  PictureFolders folders;
  folders.color = JoinPath(directory, "Left_rectified");
  folders.right = JoinPath(directory, "Right_rectified");
  folders.depth = ServCtDepth(directory);
  StatusOr<SequenceListing> listing = ListStereoFolders(folders);
  if (!listing.ok()) return listing;
  const std::string& path = calibrations.begin()->second;
  StatusOr<StereoCalibration> calibration = ReadServCtCalibration(path);
  if (!calibration.ok()) return calibration.status();
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing->entries.front().color);
  if (!size.ok()) return size.status();
  Status status = FitCalibration(path, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  // One camera for all pairs: a pair with another one is left out.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < listing->entries.size(); ++i) {
    const auto file = calibrations.find(listing->entries[i].number);
    if (file != calibrations.end()) {
      const StatusOr<StereoCalibration> other = ReadServCtCalibration(file->second);
      if (!other.ok()) return other.status();
      const PinholeCamera& a = calibration->rig.left.pinhole;
      const PinholeCamera& b = other->rig.left.pinhole;
      if (a.fx != b.fx || a.cx != b.cx || a.cy != b.cy) continue;
    }
    if (kept != i) listing->entries[kept] = std::move(listing->entries[i]);
    ++kept;
  }
  if (kept == 0) {
    return Status::Error(folder + ": no pair has the calibration of " + path +
                         ", expected the number of a pair as its name");
  }
  if (kept < listing->entries.size()) {
    listing->warnings.push_back(folder + ": " + std::to_string(listing->entries.size() - kept) +
                                " of " + std::to_string(listing->entries.size()) +
                                " pairs have another calibration than the first and are left out");
    listing->entries.resize(kept);
  }
  SetCalibration(*calibration, &*listing);
  listing->camera.depth_units_per_metre = kUnitsPerMetre;
  return listing;
}

}  // namespace ceres_ed
