// STIR: left*/seqNN/frames/<a>ms-<b>ms.mp4, the same in right*, and calib.json above them.
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/layouts/stir_clip.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// Where the parts of one clip are.
struct Clip {
  // The folder seqNN of the left camera, and of the right one.
  fs::path left;
  fs::path right;
  fs::path calibration;
};

// Returns the folder `path` without "." or a slash at its end.
fs::path Normal(const std::string& path) {
  std::error_code ignored;
  const fs::path normal = fs::canonical(path, ignored);
  return ignored ? fs::path(path) : normal;
}

bool BeginsWith(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

Clip ClipOf(const fs::path& left) {
  Clip clip;
  clip.left = left;
  const fs::path side = left.parent_path();
  const std::string right = "right" + side.filename().string().substr(4);
  clip.right = side.parent_path() / right / left.filename();
  clip.calibration = side.parent_path() / "calib.json";
  return clip;
}

// Returns the clips in the folder of a recording, which has calib.json.
std::vector<fs::path> ClipsIn(const fs::path& recording) {
  std::vector<fs::path> clips;
  for (const std::string& side : FolderNames(recording.string())) {
    if (!BeginsWith(side, "left")) continue;
    for (const std::string& name : FolderNames((recording / side).string())) {
      if (BeginsWith(name, "seq")) clips.push_back(recording / side / name);
    }
  }
  return clips;
}

bool IsClipFolder(const fs::path& directory) {
  return BeginsWith(directory.parent_path().filename().string(), "left") &&
         IsFolder((directory / "frames").string());
}

StatusOr<Clip> FindClip(const std::string& directory) {
  const fs::path folder = Normal(directory);
  if (IsClipFolder(folder)) return ClipOf(folder);
  const std::vector<fs::path> clips = ClipsIn(folder);
  if (clips.size() == 1) return ClipOf(clips[0]);
  if (clips.empty()) {
    return Status::Error(directory + ": no clip, expected left*/seqNN/frames/ with a video");
  }
  return Status::Error(directory + ": has " + std::to_string(clips.size()) +
                       " clips, expected the folder of one of them, such as " + clips[0].string());
}

// Returns the video of a clip. Its name has no meaning for us: <start>ms-<end>ms.
StatusOr<std::string> VideoOf(const fs::path& clip) {
  const std::string frames = (clip / "frames").string();
  const std::vector<std::string> videos = VideosIn(frames);
  if (videos.size() == 1) return videos[0];
  return Status::Error(frames + ": has " + std::to_string(videos.size()) +
                       " videos, expected one: <start>ms-<end>ms.mp4");
}

// The cameras are parallel and without distortion, up to rounding: the rows correspond. Returns
// whether this is so, and removes what rounding has left.
bool MakeRectified(StereoRig* rig) {
  constexpr double kRounding = 1e-6;
  const auto bends = [](double coefficient) { return coefficient != 0.0; };
  const PinholeCamera& left = rig->left.pinhole;
  PinholeCamera& right = rig->right.pinhole;
  const Eigen::Vector3d shift = rig->right_from_left.translation;
  const bool is_rectified =
      std::none_of(rig->left.distortion.begin(), rig->left.distortion.end(), bends) &&
      std::none_of(rig->right.distortion.begin(), rig->right.distortion.end(), bends) &&
      rig->right_from_left.rotation.vec().norm() < kRounding &&
      shift.tail<2>().norm() <= kRounding && std::abs(left.fx - right.fx) <= kRounding * left.fx &&
      std::abs(left.fy - right.fy) <= kRounding * left.fy && std::abs(left.cy - right.cy) <= 1e-3;
  if (!is_rectified) return false;
  rig->right_from_left.rotation.setIdentity();
  rig->right_from_left.translation = {shift.x(), 0.0, 0.0};
  right.fx = left.fx;
  right.fy = left.fy;
  right.cy = left.cy;
  return true;
}

}  // namespace

StatusOr<std::string> FindStirClip(const std::string& directory) {
  const StatusOr<Clip> clip = FindClip(directory);
  if (!clip.ok()) return clip.status();
  return clip->left.string();
}

bool IsStir(const std::string& directory) {
  const fs::path folder = Normal(directory);
  return IsClipFolder(folder) ||
         (IsFile((folder / "calib.json").string()) && !ClipsIn(folder).empty());
}

StatusOr<SequenceListing> ListStir(const std::string& directory) {
  const StatusOr<Clip> clip = FindClip(directory);
  if (!clip.ok()) return clip.status();
  const std::string path = clip->calibration.string();
  if (!IsFile(path)) {
    return MissingCalibration(path,
                              "leftcameramat, rightcameramat, leftdistortioncoeffs, "
                              "rightdistortioncoeffs, rotation and translation");
  }
  StatusOr<StereoCalibration> calibration = ReadStirCalibration(path);
  if (!calibration.ok()) return calibration.status();
  const StatusOr<std::string> left = VideoOf(clip->left);
  if (!left.ok()) return left.status();
  const StatusOr<std::string> right = VideoOf(clip->right);
  if (!right.ok()) return right.status();
  SequenceListing listing;
  Status status = AddTwoVideos(*left, *right, 0, &listing);
  if (!status.ok()) return status;
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing.entries.front().color);
  if (!size.ok()) return size.status();
  status = FitCalibration(path, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  calibration->is_rectified = MakeRectified(&calibration->rig);
  SetCalibration(*calibration, &listing);
  return listing;
}

}  // namespace ceres_ed
