// D4D: a clip with rectified stereo pictures, depth by a network, and camera_info files of ROS.
#include <ceres_ed/io/pose_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

#include <filesystem>

namespace ceres_ed {
namespace {

namespace fs = std::filesystem;

// Returns the camera_info of a side: in the clip, else in the session two folders above.
std::string CameraInfo(const std::string& directory, const std::string& side) {
  const std::string own = JoinPath(directory, "camera_info");
  for (const std::string& name : FileNames(own)) {
    const bool is_rectified = name.rfind(side + "_rect", 0) == 0;
    if (is_rectified && fs::path(name).extension() == ".yaml") return JoinPath(own, name);
  }
  return FirstFile(directory,
                   {"camera_info/" + side + ".yaml", "../../camera_info/" + side + ".yaml"});
}

// Files correspond by their order: their names are times of different clocks.
Status AddFrames(const std::string& directory, SequenceListing* listing) {
  const std::string left = JoinPath(directory, "left_images_rect");
  const std::string right = JoinPath(directory, "right_images_rect");
  const std::vector<TimedPicture> lefts = PicturesInOrder(left, {".png", ".jpg"});
  const std::vector<TimedPicture> rights = PicturesInOrder(right, {".png", ".jpg"});
  if (lefts.empty() || lefts.size() != rights.size()) {
    return Status::Error(directory + ": left_images_rect/ has " + std::to_string(lefts.size()) +
                         " pictures and right_images_rect/ has " + std::to_string(rights.size()) +
                         ", expected the same number, at least one");
  }
  const std::vector<TimedPicture> depths =
      PicturesInOrder(JoinPath(directory, "stereo_depth"), {".npy"});
  const std::vector<TimedPicture> masks =
      PicturesInOrder(JoinPath(directory, "left_images_rect_masks"), {".png"});
  for (std::size_t i = 0; i < lefts.size(); ++i) {
    SequenceEntry entry;
    entry.number = static_cast<int>(i);
    entry.time_s = lefts[i].time_s - lefts[0].time_s;
    entry.color.path = lefts[i].path;
    entry.right.path = rights[i].path;
    if (depths.size() == lefts.size()) entry.depth.path = depths[i].path;
    if (masks.size() == lefts.size()) entry.mask.path = masks[i].path;
    listing->entries.push_back(std::move(entry));
  }
  listing->has_color = true;
  listing->has_masks = !masks.empty() && masks.size() == lefts.size();
  listing->mask_meaning = MaskMeaning::kUnknown;
  for (const auto& [name, count] : {std::pair("stereo_depth/", depths.size()),
                                    std::pair("left_images_rect_masks/", masks.size())}) {
    if (count == 0 || count == lefts.size()) continue;
    listing->warnings.push_back(directory + ": " + name + " has " + std::to_string(count) +
                                " files for " + std::to_string(lefts.size()) +
                                " pictures and is left out");
  }
  return Status::Ok();
}

}  // namespace

bool IsD4d(const std::string& directory) {
  return IsFolder(JoinPath(directory, "left_images_rect"));
}

StatusOr<SequenceListing> ListD4d(const std::string& directory) {
  const std::string left = CameraInfo(directory, "left");
  const std::string right = CameraInfo(directory, "right");
  if (left.empty() || right.empty()) {
    return MissingCalibration(
        JoinPath(directory,
                 left.empty() ? "camera_info/left_rect.yaml" : "camera_info/right_rect.yaml"),
        "camera_info of ROS with image_width, image_height and projection_matrix");
  }
  StatusOr<StereoCalibration> calibration = ReadRosCalibration(left, right);
  if (!calibration.ok()) return calibration.status();
  SequenceListing listing;
  Status status = AddFrames(directory, &listing);
  if (!status.ok()) return status;
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing.entries.front().color);
  if (!size.ok()) return size.status();
  status = FitCalibration(left, size->first, size->second, &*calibration);
  if (!status.ok()) return status;
  SetCalibration(*calibration, &listing);
  listing.camera.depth_units_per_metre = 1.0;
  // The poses of the first and of the last frame.
  for (const auto& [name, entry] :
       {std::pair("start", &listing.entries.front()), std::pair("end", &listing.entries.back())}) {
    const std::string path =
        JoinPath(directory, std::string("curated_camera_pose_") + name + ".txt");
    if (!IsFile(path)) continue;
    StatusOr<CameraPose> pose = ReadPoseMatrix(path, 1.0);
    if (!pose.ok()) return pose.status();
    constexpr double kFarthestMetres = 5.0;
    constexpr double kMetresPerMillimetre = 1e-3;
    if (pose->translation.norm() > kFarthestMetres) {
      pose->translation *= kMetresPerMillimetre;
      listing.warnings.push_back(path + ": the translation is taken as millimetres");
    }
    entry->world_from_camera = *pose;
  }
  return listing;
}

}  // namespace ceres_ed
