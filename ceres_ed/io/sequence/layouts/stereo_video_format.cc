// One or two videos beside stereo.txt, or beside a calibration that OpenCV has written.
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/layouts/stereo_file.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

#include <cstddef>

namespace ceres_ed {
namespace {

// Returns the calibration in a folder: stereo.txt or calibration.yaml.
StatusOr<StereoCalibration> ReadCalibration(const std::string& directory) {
  const std::string stereo = JoinPath(directory, "stereo.txt");
  if (!IsFile(stereo)) return ReadOpenCvCalibration(JoinPath(directory, "calibration.yaml"));
  const StatusOr<StereoRig> rig = ReadStereoFile(stereo);
  if (!rig.ok()) return rig.status();
  StereoCalibration calibration;
  calibration.rig = *rig;
  calibration.is_rectified = true;
  return calibration;
}

// Returns which of two videos is the left one: the one whose name has "left", or the first one.
bool IsSwapped(const std::vector<std::string>& videos) {
  const auto has = [](const std::string& path, const char* word) {
    return path.substr(path.find_last_of('/') + 1).find(word) != std::string::npos;
  };
  return has(videos[1], "left") || has(videos[0], "right");
}

}  // namespace

bool IsStereoVideo(const std::string& directory) {
  return (IsFile(JoinPath(directory, "stereo.txt")) ||
          IsFile(JoinPath(directory, "calibration.yaml"))) &&
         !IsFile(JoinPath(directory, "info.yaml")) && !VideosIn(directory).empty() &&
         !IsFolder(JoinPath(directory, "left"));
}

StatusOr<SequenceListing> ListStereoVideo(const std::string& directory) {
  std::vector<std::string> videos = VideosIn(directory);
  if (videos.empty() || videos.size() > 2) {
    return Status::Error(directory + ": has " + std::to_string(videos.size()) +
                         " videos, expected one with both pictures, or one a camera");
  }
  StatusOr<StereoCalibration> calibration = ReadCalibration(directory);
  if (!calibration.ok()) return calibration.status();
  SequenceListing listing;
  Status status = Status::Ok();
  if (videos.size() == 1) {
    const PinholeCamera& camera = calibration->rig.left.pinhole;
    const StatusOr<Stacking> stacking =
        FindStacking(videos[0], camera.width, camera.height, &listing);
    if (!stacking.ok()) return stacking.status();
    status = AddStackedVideo(videos[0], *stacking, 0, &listing);
  } else {
    if (IsSwapped(videos)) std::swap(videos[0], videos[1]);
    listing.warnings.push_back(videos[0] + ": is taken as the left camera, and " + videos[1] +
                               " as the right one");
    status = AddTwoVideos(videos[0], videos[1], 0, &listing);
  }
  if (!status.ok()) return status;
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing.entries.front().color);
  if (!size.ok()) return size.status();
  status = FitCalibration(directory, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  SetCalibration(*calibration, &listing);
  return listing;
}

}  // namespace ceres_ed
