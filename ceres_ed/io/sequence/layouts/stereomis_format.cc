// StereoMIS: a video with the left picture above the right one, or its rectified frames.
#include <ceres_ed/io/calibration/rectify_rig.h>
#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

#include <cmath>
#include <cstddef>

namespace ceres_ed {
namespace {

// Frames are numbered from 1: number - 1 is the row of a pose.
constexpr int kFirstNumber = 1;

std::string CalibrationPath(const std::string& directory) {
  return FirstFile(directory, {"StereoCalibration.ini", "camcal.json", "camera_calibration.json"});
}

// Returns the folder of unpacked frames, whose name may go on (video_frames_1); or "".
std::string FramesFolder(const std::string& directory) {
  for (const std::string& name : FolderNames(directory)) {
    if (name.rfind("video_frames", 0) == 0) return JoinPath(directory, name);
  }
  return "";
}

StatusOr<StereoCalibration> ReadCalibration(const std::string& directory) {
  const std::string path = CalibrationPath(directory);
  if (path.empty()) {
    return MissingCalibration(JoinPath(directory, "StereoCalibration.ini"),
                              "sections StereoLeft and StereoRight with res_x, fc_x, cc_x, kc_0 "
                              "and so on, R_0 and T_0");
  }
  return path.substr(path.size() - 4) == ".ini" ? ReadIniCalibration(path)
                                                : ReadCamcalCalibration(path);
}

// Makes the calibration that of pictures that were first scaled to a width, then cut above and
// below, and then rectified.
Status RectifyAsUnpacked(const std::string& path,
                         int width,
                         int height,
                         StereoCalibration* calibration) {
  const PinholeCamera original = calibration->rig.left.pinhole;
  const double factor = static_cast<double>(width) / original.width;
  const int scaled_height = static_cast<int>(std::lround(factor * original.height));
  if (scaled_height < height) {
    return Status::Error(path + ": is for pictures of " + std::to_string(original.width) + " x " +
                         std::to_string(original.height) + " pixels, and these have " +
                         std::to_string(width) + " x " + std::to_string(height) +
                         ", expected the same ratio, or less height");
  }
  Status status = FitCalibration(path, width, scaled_height, calibration);
  if (!status.ok()) return status;
  // The program cuts whole rows.
  const int rows_above = (scaled_height - height) / 2;
  for (PinholeCamera* camera : {&calibration->rig.left.pinhole, &calibration->rig.right.pinhole}) {
    camera->cy -= rows_above;
    camera->height = height;
  }
  calibration->rig = RectifyRig(calibration->rig);
  calibration->is_rectified = true;
  return Status::Ok();
}

Status ListUnpacked(const std::string& folder, SequenceListing* listing) {
  const std::map<int, std::string> left = FilesByNumber(folder, "l.png");
  const std::map<int, std::string> right = FilesByNumber(folder, "r.png");
  for (const auto& [number, path] : left) {
    const auto partner = right.find(number);
    if (partner == right.end()) continue;
    SequenceEntry entry;
    entry.number = number;
    entry.time_s = number;
    entry.color.path = path;
    entry.right.path = partner->second;
    listing->entries.push_back(std::move(entry));
  }
  listing->has_color = true;
  if (!listing->entries.empty()) return Status::Ok();
  return Status::Error(folder + ": no pictures, expected NNNNNNl.png and NNNNNNr.png");
}

// Adds masks/NNNNNNl.png, in which tissue is not 0.
void AddMasks(const std::string& directory, SequenceListing* listing) {
  const std::map<int, std::string> masks = FilesByNumber(JoinPath(directory, "masks"), "l.png");
  listing->has_masks = !masks.empty();
  listing->mask_meaning = MaskMeaning::kUsed;
  AddMasksByNumber(masks, listing);
}

Status AddPoses(const std::string& directory, SequenceListing* listing) {
  const std::string path = JoinPath(directory, "groundtruth.txt");
  if (!IsFile(path)) return Status::Ok();
  const StatusOr<std::vector<TimedPose>> poses = ReadTrajectory(path);
  if (!poses.ok()) return poses.status();
  for (SequenceEntry& entry : listing->entries) {
    const auto row = static_cast<std::size_t>(entry.number - kFirstNumber);
    if (entry.number >= kFirstNumber && row < poses->size()) {
      entry.world_from_camera = (*poses)[row].world_from_camera;
    }
  }
  listing->has_poses = true;
  return Status::Ok();
}

}  // namespace

bool IsStereoMis(const std::string& directory) {
  return !CalibrationPath(directory).empty() &&
         (!VideosIn(directory).empty() || !FramesFolder(directory).empty());
}

StatusOr<SequenceListing> ListStereoMis(const std::string& directory) {
  StatusOr<StereoCalibration> calibration = ReadCalibration(directory);
  if (!calibration.ok()) return calibration.status();
  const std::string path = CalibrationPath(directory);
  SequenceListing listing;
  const std::string frames = FramesFolder(directory);
  const std::vector<std::string> videos = VideosIn(directory);
  if (!frames.empty()) {
    Status status = ListUnpacked(frames, &listing);
    if (!status.ok()) return status;
    listing.warnings.push_back(frames +
                               ": the pictures are taken as rectified, as the data set's "
                               "own program unpacks them");
  } else if (videos.size() == 1) {
    Status status = AddStackedVideo(videos[0], Stacking::kVertical, kFirstNumber, &listing);
    if (!status.ok()) return status;
  } else {
    return Status::Error(directory + ": has " + std::to_string(videos.size()) +
                         " videos, expected one, or a folder video_frames/ of NNNNNNl.png and "
                         "NNNNNNr.png");
  }
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing.entries.front().color);
  if (!size.ok()) return size.status();
  Status status = frames.empty()
                      ? FitCalibration(path, size->first, size->second, &*calibration)
                      : RectifyAsUnpacked(path, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  SetCalibration(*calibration, &listing);
  AddMasks(directory, &listing);
  status = AddPoses(directory, &listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
