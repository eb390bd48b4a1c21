#include "ceres_ed/io/sequence/sequence_format.h"

#include <ceres_ed/io/calibration/camera_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_listing.h>

namespace ceres_ed {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;

// Returns the first of the names that is a folder, or the last name.
std::string ChooseFolder(const std::string& directory, const char* name, const char* other_name) {
  const std::string path = JoinPath(directory, name);
  return IsFolder(path) ? path : JoinPath(directory, other_name);
}

}  // namespace

bool IsHamlynSequence(const std::string& directory) {
  return IsFile(JoinPath(directory, "intrinsics.txt"));
}

StatusOr<SequenceListing> ListHamlynSequence(const std::string& directory) {
  const std::string path = JoinPath(directory, "intrinsics.txt");
  const StatusOr<CameraMatrixFile> intrinsics = ReadIntrinsicsFile(path);
  if (!intrinsics.ok()) return intrinsics.status();
  const std::string depth_folder = ChooseFolder(directory, "depth", "depth01");
  if (!IsFolder(depth_folder)) {
    return Status::Error(directory + ": no depth, expected a folder depth/ or depth01/ in it");
  }
  PictureFolders folders;
  folders.depth = depth_folder;
  folders.color = ChooseFolder(directory, "color", "image01");
  folders.mask = JoinPath(directory, "mask");
  StatusOr<SequenceListing> listing = ListPictureFolders(folders);
  if (!listing.ok()) return listing.status();
  listing->camera = {intrinsics->camera, kMillimetresPerMetre};
  Status status = SetSizeFromPictures(listing->entries, &listing->camera.camera);
  if (!status.ok()) return status;
  PinholeCamera& camera = listing->camera.camera;
  status = FitCamera(path, camera.width, camera.height, &camera);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
