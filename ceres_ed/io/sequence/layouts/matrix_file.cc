#include "ceres_ed/io/sequence/layouts/matrix_file.h"

#include <ceres_ed/io/text.h>
#include <ceres_ed/io/text_rows.h>

#include <cstddef>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace ceres_ed {

StatusOr<Eigen::MatrixXd> ReadMatrixFile(const std::string& path, int rows, int columns) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  const std::string expected =
      ", expected " + std::to_string(rows) + " rows of " + std::to_string(columns) + " numbers";
  int row_index = 0;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    if (row_index == rows) return Status::Error(row.place + "one more row" + expected);
    if (row.fields.size() != static_cast<std::size_t>(columns)) {
      return Status::Error(row.place + std::to_string(row.fields.size()) + " fields" + expected);
    }
    for (int column = 0; column < columns; ++column) {
      const StatusOr<double> number = ParseFinite(row.place,
                                                  "column " + std::to_string(column + 1),
                                                  row.fields[static_cast<std::size_t>(column)]);
      if (!number.ok()) return number.status();
      matrix(row_index, column) = *number;
    }
    ++row_index;
    return Status::Ok();
  });
  if (!status.ok()) return status;
  if (row_index != rows) {
    return Status::Error(path + ": " + std::to_string(row_index) + " rows" + expected);
  }
  return matrix;
}

StatusOr<PinholeCamera> ReadCameraMatrix(const std::string& path) {
  const StatusOr<Eigen::MatrixXd> matrix = ReadMatrixFile(path, 3, 3);
  if (!matrix.ok()) return matrix.status();
  PinholeCamera camera{(*matrix)(0, 0), (*matrix)(1, 1), (*matrix)(0, 2), (*matrix)(1, 2), 1, 1};
  std::string error;
  if (!camera.IsValid(&error)) return Status::Error(path + ": " + error);
  Eigen::Matrix3d rest = *matrix;
  rest(0, 0) = rest(1, 1) = rest(0, 2) = rest(1, 2) = 0.0;
  rest(2, 2) -= 1.0;
  if (rest.cwiseAbs().maxCoeff() <= 1e-6) return camera;
  return Status::Error(path + ": the rows are no camera matrix, expected fx 0 cx, 0 fy cy, 0 0 1");
}

StatusOr<RigidTransform> ReadTransformMatrix(const std::string& path, double scale) {
  const StatusOr<Eigen::MatrixXd> matrix = ReadMatrixFile(path, 4, 4);
  if (!matrix.ok()) return matrix.status();
  const Eigen::Matrix3d linear = matrix->topLeftCorner(3, 3);
  const double error = (linear * linear.transpose() - Eigen::Matrix3d::Identity()).norm();
  const bool is_last_row = matrix->row(3).isApprox(Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0), 1e-9);
  if (error > 1e-3 || linear.determinant() <= 0.0 || !is_last_row) {
    return Status::Error(path +
                         ": no rigid transform, expected the rows of a rotation, each with its "
                         "part of the translation, and 0 0 0 1");
  }
  // The nearest rotation, as files have few digits.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  RigidTransform transform;
  transform.rotation =
      Eigen::Quaterniond(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose())).normalized();
  transform.translation = scale * matrix->topRightCorner(3, 1);
  return transform;
}

StatusOr<std::array<double, 8>> ReadDistortionFile(const std::string& path) {
  std::array<double, 8> coefficients{};
  std::size_t count = 0;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    for (const std::string_view field : row.fields) {
      if (count == coefficients.size()) {
        return Status::Error(row.place + Quoted(field) + " behind the eighth number, expected " +
                             "4 to 8 coefficients k1 k2 p1 p2 k3 k4 k5 k6");
      }
      const StatusOr<double> number = ParseFinite(row.place, "a coefficient", field);
      if (!number.ok()) return number.status();
      coefficients[count++] = *number;
    }
    return Status::Ok();
  });
  if (!status.ok()) return status;
  if (count < 4) {
    return Status::Error(path + ": " + std::to_string(count) +
                         " numbers, expected 4 to 8 coefficients k1 k2 p1 p2 k3 k4 k5 k6");
  }
  return coefficients;
}

}  // namespace ceres_ed
