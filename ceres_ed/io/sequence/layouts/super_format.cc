// SuPer: rgb/NNNNNN-left.png and depth/ of .npy or .png files. The intrinsics stand in the program
// of the data set, not in its files.
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {
namespace {

// The two recordings, as their program gives them.
constexpr PinholeCamera kFirst = {883.0, 883.0, 445.06, 190.24, 640, 480};

// Returns the depth of the frames, and its units per metre.
std::map<int, std::string> Depths(const std::string& directory, double* units_per_metre) {
  const std::string folder = JoinPath(directory, "depth");
  *units_per_metre = 1.0;
  for (const char* suffix : {"-left.npy", "-left_depth.npy", ".npy"}) {
    std::map<int, std::string> files = FilesByNumber(folder, suffix);
    if (!files.empty()) return files;
  }
  *units_per_metre = 1000.0;
  for (const char* suffix : {"-left.png", "-left_depth.png", ".png"}) {
    std::map<int, std::string> files = FilesByNumber(folder, suffix);
    if (!files.empty()) return files;
  }
  return {};
}

Status SetCamera(const std::string& directory, SequenceListing* listing) {
  const std::string path = JoinPath(directory, "camera.txt");
  const StatusOr<bool> is_given = UseCameraFile(directory, &listing->camera.camera);
  if (!is_given.ok()) return is_given.status();
  if (*is_given) return Status::Ok();
  const StatusOr<std::pair<int, int>> size = ReadSourceSize(listing->entries.front().color);
  if (!size.ok()) return size.status();
  StereoCalibration nominal;
  nominal.rig.left.pinhole = nominal.rig.right.pinhole = kFirst;
  Status status = FitCalibration(path, size->first, size->second, &nominal);
  if (!status.ok()) return status;
  listing->camera.camera = nominal.rig.left.pinhole;
  listing->warnings.push_back(path +
                              ": not there; the intrinsics are taken as those of the first "
                              "recording of SuPer, 883 883 445.06 190.24 at 640 x 480 (the second "
                              "one has 768.986 768.986 292.886 291.615: write them to this file "
                              "as fx fy cx cy width height depth_units_per_metre)");
  return Status::Ok();
}

}  // namespace

bool IsSuper(const std::string& directory) {
  return !FilesByNumber(JoinPath(directory, "rgb"), "-left.png").empty();
}

StatusOr<SequenceListing> ListSuper(const std::string& directory) {
  const std::map<int, std::string> colors = FilesByNumber(JoinPath(directory, "rgb"), "-left.png");
  double units_per_metre = 1.0;
  const std::map<int, std::string> depths = Depths(directory, &units_per_metre);
  SequenceListing listing;
  for (const auto& [number, path] : colors) {
    const auto depth = depths.find(number);
    if (depth == depths.end()) continue;
    SequenceEntry entry;
    entry.number = number;
    entry.time_s = number;
    entry.color.path = path;
    entry.depth.path = depth->second;
    listing.entries.push_back(std::move(entry));
  }
  if (listing.entries.empty()) {
    return Status::Error(JoinPath(directory, "depth") +
                         ": no depth for a picture of rgb/, expected NNNNNN-left.npy in metres or "
                         "NNNNNN-left.png in millimetres: the layout has no baseline");
  }
  listing.has_color = true;
  listing.camera.depth_units_per_metre = units_per_metre;
  Status status = SetCamera(directory, &listing);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
