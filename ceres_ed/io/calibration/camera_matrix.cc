#include "ceres_ed/io/calibration/camera_matrix.h"

#include <ceres_ed/io/text_rows.h>

#include <cstddef>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

// Returns the numbers of one row, with 0 for a missing fourth column.
StatusOr<Eigen::RowVector4d> ParseMatrixRow(const TextRow& row) {
  if (row.fields.size() != 3 && row.fields.size() != 4) {
    return Status::Error(row.place + std::to_string(row.fields.size()) +
                         (row.fields.size() == 1 ? " number" : " numbers") +
                         ", expected 3 or 4 in each of 3 rows of the camera matrix");
  }
  Eigen::RowVector4d numbers = Eigen::RowVector4d::Zero();
  for (std::size_t column = 0; column < row.fields.size(); ++column) {
    const StatusOr<double> number =
        ParseFinite(row.place, "column " + std::to_string(column + 1), row.fields[column]);
    if (!number.ok()) return number.status();
    numbers[static_cast<Eigen::Index>(column)] = *number;
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

// Returns whether a fourth row and column are those of the identity.
bool EndsAsIdentity(const Eigen::Matrix4d& matrix) {
  Eigen::Vector4d last = matrix.col(3);
  last[3] -= 1.0;
  return last.cwiseAbs().maxCoeff() <= 1e-6 &&
         matrix.row(3).head<3>().cwiseAbs().maxCoeff() <= 1e-6;
}

}  // namespace

StatusOr<CameraMatrixFile> ReadIntrinsicsFile(const std::string& path) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Index num_rows = 0;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    if (num_rows == 3 && row.fields.size() != 4) {
      return Status::Error(row.place + "a fourth row, expected 3 rows of 3 or 4 numbers");
    }
    if (num_rows == 4) {
      return Status::Error(row.place + "a fifth row, expected 3 or 4 rows");
    }
    const StatusOr<Eigen::RowVector4d> numbers = ParseMatrixRow(row);
    if (!numbers.ok()) return numbers.status();
    matrix.row(num_rows++) = *numbers;
    return Status::Ok();
  });
  if (!status.ok()) return status;
  if (num_rows < 3) {
    return Status::Error(path + ": " + std::to_string(num_rows) +
                         (num_rows == 1 ? " row" : " rows") +
                         ", expected 3 rows of 3 or 4 numbers: fx 0 cx, 0 fy cy, 0 0 1");
  }
  CameraMatrixFile file;
  file.rows = static_cast<int>(num_rows);
  file.camera = {matrix(0, 0), matrix(1, 1), matrix(0, 2), matrix(1, 2), 1, 1};
  std::string error;
  if (!file.camera.IsValid(&error)) return Status::Error(path + ": " + error);
  if (!HasPinholeZeros(matrix.topLeftCorner<3, 3>())) {
    return Status::Error(path +
                         ": the rows are no camera matrix of a rectified picture, expected "
                         "fx 0 cx, 0 fy cy, 0 0 1");
  }
  if (num_rows == 4 && !EndsAsIdentity(matrix)) {
    return Status::Error(path +
                         ": the fourth row and column are not those of the identity, expected a "
                         "camera matrix of 4 x 4 numbers");
  }
  return file;
}

}  // namespace ceres_ed
