// DeepDeform: color/, depth/ in millimetres, and intrinsics.txt of 4 x 4 numbers.
#include <ceres_ed/io/calibration/camera_matrix.h>
#include <ceres_ed/io/sequence/layouts/layout_files.h>
#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_format.h>

namespace ceres_ed {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;

}  // namespace

bool IsDeepDeform(const std::string& directory) {
  const std::string path = JoinPath(directory, "intrinsics.txt");
  if (!IsFile(path) || !IsFolder(JoinPath(directory, "depth"))) return false;
  const StatusOr<CameraMatrixFile> file = ReadIntrinsicsFile(path);
  return file.ok() && file->rows == 4;
}

StatusOr<SequenceListing> ListDeepDeform(const std::string& directory) {
  const std::string path = JoinPath(directory, "intrinsics.txt");
  if (!IsFile(path)) {
    return MissingCalibration(path, "4 rows of 4 numbers: fx 0 cx 0, 0 fy cy 0, 0 0 1 0, 0 0 0 1");
  }
  const StatusOr<CameraMatrixFile> file = ReadIntrinsicsFile(path);
  if (!file.ok()) return file.status();
  StatusOr<SequenceListing> listing = ListPictureFolders({JoinPath(directory, "depth"),
                                                          JoinPath(directory, "color"),
                                                          "",
                                                          JoinPath(directory, "mask")});
  if (!listing.ok()) return listing;
  listing->camera = {file->camera, kMillimetresPerMetre};
  Status status = SetSizeFromPictures(listing->entries, &listing->camera.camera);
  if (!status.ok()) return status;
  PinholeCamera& camera = listing->camera.camera;
  status = FitCamera(path, camera.width, camera.height, &camera);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
