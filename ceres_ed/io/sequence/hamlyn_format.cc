#include "ceres_ed/io/sequence/sequence_format.h"

#include <ceres_ed/io/sequence/picture_files.h>
#include <ceres_ed/io/sequence/sequence_listing.h>
#include <ceres_ed/io/text_rows.h>

#include <cmath>
#include <cstddef>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

constexpr double kMillimetresPerMetre = 1000.0;

// Returns the numbers of one row. A fourth column belongs to the other camera and is not used.
StatusOr<Eigen::RowVector3d> ParseMatrixRow(const TextRow& row) {
  if (row.fields.size() != 3 && row.fields.size() != 4) {
    return Status::Error(row.place + std::to_string(row.fields.size()) +
                         (row.fields.size() == 1 ? " number" : " numbers") +
                         ", expected 3 or 4 in each of 3 rows of the camera matrix");
  }
  Eigen::RowVector3d numbers;
  for (std::size_t column = 0; column < row.fields.size(); ++column) {
    const StatusOr<double> number =
        ParseFinite(row.place, "column " + std::to_string(column + 1), row.fields[column]);
    if (!number.ok()) return number.status();
    if (column < 3) numbers[static_cast<Eigen::Index>(column)] = *number;
  }
  return numbers;
}

// Returns whether the matrix is that of a pinhole camera without skew, up to rounding.
bool HasPinholeZeros(const Eigen::Matrix3d& matrix) {
  Eigen::Matrix3d rest = matrix;
  rest(0, 0) = rest(1, 1) = rest(0, 2) = rest(1, 2) = 0.0;
  rest(2, 2) -= 1.0;
  return rest.cwiseAbs().maxCoeff() <= 1e-6;
}

StatusOr<PinholeCamera> ReadIntrinsics(const std::string& path) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Index num_rows = 0;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    if (num_rows == 3) {
      return Status::Error(row.place + "a fourth row, expected 3 rows of 3 or 4 numbers");
    }
    const StatusOr<Eigen::RowVector3d> numbers = ParseMatrixRow(row);
    if (!numbers.ok()) return numbers.status();
    matrix.row(num_rows++) = *numbers;
    return Status::Ok();
  });
  if (!status.ok()) return status;
  if (num_rows != 3) {
    return Status::Error(path + ": " + std::to_string(num_rows) +
                         (num_rows == 1 ? " row" : " rows") +
                         ", expected 3 rows of 3 or 4 numbers: fx 0 cx, 0 fy cy, 0 0 1");
  }
  PinholeCamera camera;
  camera.fx = matrix(0, 0);
  camera.fy = matrix(1, 1);
  camera.cx = matrix(0, 2);
  camera.cy = matrix(1, 2);
  // The size is taken from the images later.
  camera.width = camera.height = 1;
  std::string error;
  if (!camera.IsValid(&error)) return Status::Error(path + ": " + error);
  if (!HasPinholeZeros(matrix)) {
    return Status::Error(path +
                         ": the rows are no camera matrix of a rectified picture, expected "
                         "fx 0 cx, 0 fy cy, 0 0 1");
  }
  return camera;
}

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
  const StatusOr<PinholeCamera> camera = ReadIntrinsics(JoinPath(directory, "intrinsics.txt"));
  if (!camera.ok()) return camera.status();
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
  listing->camera = {*camera, kMillimetresPerMetre};
  Status status = SetSizeFromPictures(listing->entries, &listing->camera.camera);
  if (!status.ok()) return status;
  return listing;
}

}  // namespace ceres_ed
