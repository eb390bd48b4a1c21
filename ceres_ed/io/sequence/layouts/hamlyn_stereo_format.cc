// Rectified stereo recordings of the Hamlyn Centre with the settings of NR-SLAM: two videos, one
// video with both pictures, or two folders of pictures.
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>
#include <ceres_ed/io/text.h>

#include <cstddef>

namespace ceres_ed {
namespace {

constexpr char kSettingsName[] = "settings.yaml";

// Returns the folders of the left and of the right camera, or two empty names.
std::pair<std::string, std::string> PictureFolderNames(const std::string& directory) {
  for (const auto& [left, right] : {std::pair("left", "right"),
                                    std::pair("image01", "image02"),
                                    std::pair("images_left", "images_right")}) {
    if (IsFolder(JoinPath(directory, left)) && IsFolder(JoinPath(directory, right))) {
      return {left, right};
    }
  }
  return {"", ""};
}

bool HasBaseline(const std::string& path) {
  const StatusOr<std::string> text = ReadWholeFile(path);
  return text.ok() && text->find("bf:") != std::string::npos;
}

// Lists the videos of a folder. Of two, the right one has "right" in its name, or comes second.
Status ListVideos(const std::string& directory,
                  const PinholeCamera& camera,
                  SequenceListing* listing) {
  std::vector<std::string> videos = VideosIn(directory);
  if (videos.size() == 1) {
    const StatusOr<Stacking> stacking =
        FindStacking(videos[0], camera.width, camera.height, listing);
    if (!stacking.ok()) return stacking.status();
    return AddStackedVideo(videos[0], *stacking, 0, listing);
  }
  if (videos.size() != 2) {
    return Status::Error(directory + ": has " + std::to_string(videos.size()) +
                         " videos, expected one a camera, or folders left/ and right/");
  }
  const auto file_name = [](const std::string& path) {
    return path.substr(path.find_last_of('/') + 1);
  };
  if (file_name(videos[0]).find("right") != std::string::npos) std::swap(videos[0], videos[1]);
  listing->warnings.push_back(videos[0] + ": is taken as the left camera, and " + videos[1] +
                              " as the right one");
  return AddTwoVideos(videos[0], videos[1], 0, listing);
}

}  // namespace

bool IsHamlynStereo(const std::string& directory) {
  const std::string path = JoinPath(directory, kSettingsName);
  return IsFile(path) && HasBaseline(path) &&
         (!PictureFolderNames(directory).first.empty() || !VideosIn(directory).empty());
}

StatusOr<SequenceListing> ListHamlynStereo(const std::string& directory) {
  const std::string path = JoinPath(directory, kSettingsName);
  if (!IsFile(path)) {
    return MissingCalibration(path, "Camera.fx, Camera.fy, Camera.cx, Camera.cy and Camera.bf");
  }
  StatusOr<StereoCalibration> calibration = ReadSlamSettings(path);
  if (!calibration.ok()) return calibration.status();
  SequenceListing listing;
  const auto [left, right] = PictureFolderNames(directory);
  if (!left.empty()) {
    PictureFolders folders;
    folders.color = JoinPath(directory, left);
    folders.right = JoinPath(directory, right);
    folders.mask = JoinPath(directory, "mask");
    StatusOr<SequenceListing> pictures = ListStereoFolders(folders);
    if (!pictures.ok()) return pictures.status();
    listing = *std::move(pictures);
  } else {
    Status status = ListVideos(directory, calibration->rig.left.pinhole, &listing);
    if (!status.ok()) return status;
  }
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing.entries.front().color);
  if (!size.ok()) return size.status();
  Status status = FitCalibration(path, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  SetCalibration(*calibration, &listing);
  return listing;
}

}  // namespace ceres_ed
