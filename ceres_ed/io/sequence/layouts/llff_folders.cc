#include "ceres_ed/io/sequence/layouts/llff_folders.h"

#include <ceres_ed/io/calibration/llff_poses.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>

#include <cstddef>

namespace ceres_ed {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;

// Returns the pictures of a folder in the order of their names, whose last digits count:
// frame-000001.color.png and 000001.png.
std::map<int, std::string> Pictures(const std::string& folder) {
  for (const char* suffix : {".color.png", ".depth.png", ".mask.png", ".png", ".jpg"}) {
    std::map<int, std::string> pictures = FilesByNumber(folder, suffix);
    if (!pictures.empty()) return pictures;
  }
  return {};
}

StatusOr<std::pair<int, int>> FirstSize(const std::string& directory) {
  const std::map<int, std::string> images = Pictures(JoinPath(directory, "images"));
  if (images.empty()) {
    return Status::Error(JoinPath(directory, "images") +
                         ": no picture, expected frame-NNNNNN.color.png or NNNNNN.png");
  }
  return ReadSourceSize({images.begin()->second, -1, PicturePart::kWhole});
}

}  // namespace

std::string LlffPosesPath(const std::string& directory) {
  if (!IsFolder(JoinPath(directory, "images"))) return "";
  return FirstFile(directory, {"poses_bounds.npy", "pose_bounds.npy"});
}

bool HasCenterForSize(const std::string& directory) {
  const std::string path = LlffPosesPath(directory);
  if (path.empty()) return false;
  const StatusOr<std::pair<int, int>> size = FirstSize(directory);
  if (!size.ok()) return false;
  const StatusOr<LlffCamera> camera = ReadLlffCamera(path, size->first, size->second);
  return camera.ok() && camera->has_center;
}

StatusOr<SequenceListing> ListLlffFolders(const std::string& directory, MaskMeaning masks) {
  const std::string path = LlffPosesPath(directory);
  if (path.empty()) {
    return MissingCalibration(JoinPath(directory, "poses_bounds.npy"),
                              "an array of (frames, 17) numbers as LLFF writes it");
  }
  const StatusOr<std::pair<int, int>> size = FirstSize(directory);
  if (!size.ok()) return size.status();
  const StatusOr<LlffCamera> camera = ReadLlffCamera(path, size->first, size->second);
  if (!camera.ok()) return camera.status();
  const std::map<int, std::string> depths = Pictures(JoinPath(directory, "depth"));
  if (depths.empty()) {
    return Status::Error(JoinPath(directory, "depth") +
                         ": no depth, expected frame-NNNNNN.depth.png: the layout has no baseline, "
                         "so its two pictures give no depth");
  }
  SequenceListing listing;
  const std::map<int, std::string> images = Pictures(JoinPath(directory, "images"));
  for (const auto& [number, depth] : depths) {
    SequenceEntry entry;
    entry.number = number;
    entry.time_s = number;
    entry.depth.path = depth;
    const auto image = images.find(number);
    if (image != images.end()) entry.color.path = image->second;
    listing.entries.push_back(std::move(entry));
  }
  listing.has_color = true;
  const std::map<int, std::string> mask_files = Pictures(JoinPath(directory, "masks"));
  listing.has_masks = !mask_files.empty();
  listing.mask_meaning = masks;
  AddMasksByNumber(mask_files, &listing);
  PinholeCamera& pinhole = listing.camera.camera;
  pinhole = {camera->focal,
             camera->focal,
             camera->has_center ? camera->cx : 0.5 * size->first,
             camera->has_center ? camera->cy : 0.5 * size->second,
             size->first,
             size->second};
  listing.camera.depth_units_per_metre = kMillimetresPerMetre;
  listing.warnings.insert(listing.warnings.end(), camera->remarks.begin(), camera->remarks.end());
  listing.warnings.push_back(JoinPath(directory, "depth") +
                             ": the layout does not say its unit, which is taken as millimetres "
                             "(depth_units_per_metre sets another one)");
  return listing;
}

}  // namespace ceres_ed
