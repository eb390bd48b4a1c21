#include "ceres_ed/io/pose_matrix.h"

#include <ceres_ed/io/text_rows.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace ceres_ed {
namespace {

constexpr Eigen::Index kNumbers = 16;

// Appends the numbers of a row.
Status AppendRow(const TextRow& row, std::vector<double>* numbers) {
  for (const std::string_view field : row.fields) {
    const StatusOr<double> number =
        ParseFinite(row.place, "number " + std::to_string(numbers->size() + 1), field);
    if (!number.ok()) return number.status();
    numbers->push_back(*number);
  }
  return Status::Ok();
}

StatusOr<Eigen::Matrix4d> MatrixOf(const std::string& place, const std::vector<double>& numbers) {
  if (numbers.size() != kNumbers) {
    return Status::Error(place + std::to_string(numbers.size()) +
                         " numbers, expected the 16 of a matrix of 4 x 4");
  }
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  return Eigen::Matrix4d(Eigen::Map<const RowMajor>(numbers.data()));
}

}  // namespace

StatusOr<CameraPose> PoseFromMatrix(const std::string& place,
                                    const Eigen::Matrix4d& matrix,
                                    double units_per_metre) {
  constexpr double kRounding = 1e-2;
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const Eigen::Vector4d last = matrix.row(3).transpose() - Eigen::Vector4d::UnitW();
  if (!matrix.allFinite() || last.cwiseAbs().maxCoeff() > kRounding ||
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() >
          kRounding ||
      rotation.determinant() < 0.0) {
    return Status::Error(place +
                         "the matrix is no pose, expected a rotation, a translation and "
                         "the last row 0 0 0 1");
  }
  CameraPose pose;
  pose.rotation = Eigen::Quaterniond(rotation).normalized();
  pose.translation = matrix.topRightCorner<3, 1>() / units_per_metre;
  return pose;
}

StatusOr<CameraPose> ReadPoseMatrix(const std::string& path, double units_per_metre) {
  std::vector<double> numbers;
  Status status =
      ForEachTextRow(path, [&numbers](const TextRow& row) { return AppendRow(row, &numbers); });
  if (!status.ok()) return status;
  const StatusOr<Eigen::Matrix4d> matrix = MatrixOf(path + ": ", numbers);
  if (!matrix.ok()) return matrix.status();
  return PoseFromMatrix(path + ": ", *matrix, units_per_metre);
}

StatusOr<std::vector<CameraPose>> ReadPoseRows(const std::string& path,
                                               double units_per_metre,
                                               bool by_columns) {
  std::vector<CameraPose> poses;
  Status status = ForEachTextRow(path, [&](const TextRow& row) {
    std::vector<double> numbers;
    Status appended = AppendRow(row, &numbers);
    if (!appended.ok()) return appended;
    StatusOr<Eigen::Matrix4d> matrix = MatrixOf(row.place, numbers);
    if (!matrix.ok()) return matrix.status();
    if (by_columns) matrix->transposeInPlace();
    const StatusOr<CameraPose> pose = PoseFromMatrix(row.place, *matrix, units_per_metre);
    if (!pose.ok()) return pose.status();
    poses.push_back(*pose);
    return Status::Ok();
  });
  if (!status.ok()) return status;
  return poses;
}

Eigen::Matrix4d MatrixOfPose(const CameraPose& pose, double units_per_metre) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = pose.translation * units_per_metre;
  return matrix;
}

}  // namespace ceres_ed
