#include "ceres_ed/io/calibration/calibration_fields.h"

#include <ceres_ed/io/text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <sstream>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace ceres_ed {
namespace {

using nlohmann::json;

// Translations from this on are taken as millimetres.
constexpr double kFirstMillimetre = 0.5;
constexpr double kMillimetresPerMetre = 1000.0;

Status Missing(const std::string& path, const std::string& name) {
  return Status::Error(path + ": no " + name + ", expected it in a calibration of this kind");
}

// Appends the numbers of a value and of the lists in it. Returns whether there is nothing else.
bool AppendAll(const json& value, std::vector<double>* numbers) {
  if (value.is_number()) {
    numbers->push_back(value.get<double>());
    return std::isfinite(numbers->back());
  }
  return value.is_array() && std::all_of(value.begin(), value.end(), [numbers](const json& item) {
           return AppendAll(item, numbers);
         });
}

Status CheckCamera(const std::string& path, const char* side, const PinholeCamera& camera) {
  PinholeCamera checked = camera;
  // The size may be unknown.
  if (checked.width == 0 && checked.height == 0) checked.width = checked.height = 1;
  std::string error;
  if (checked.IsValid(&error)) return Status::Ok();
  return Status::Error(path + ": " + side + " camera: " + error);
}

}  // namespace

const json* FindField(const json& fields, const std::string& name) {
  if (!fields.is_object()) return nullptr;
  const auto direct = fields.find(name);
  if (direct != fields.end()) return &*direct;
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return nullptr;
  const auto outer = fields.find(name.substr(0, dot));
  return outer == fields.end() ? nullptr : FindField(*outer, name.substr(dot + 1));
}

StatusOr<std::vector<double>> ReadNumbers(const std::string& path,
                                          const json& fields,
                                          const std::string& name) {
  const json* field = FindField(fields, name);
  if (field == nullptr) return Missing(path, name);
  if (field->is_object()) {
    field = FindField(*field, "data");
    if (field == nullptr) return Missing(path, name + ".data");
  }
  std::vector<double> numbers;
  if (!AppendAll(*field, &numbers)) {
    // Bytes that are no text would end the program.
    const std::string text = field->dump(-1, ' ', false, json::error_handler_t::replace);
    return Status::Error(path + ": " + name + " is " + Quoted(text) + ", expected finite numbers");
  }
  return numbers;
}

StatusOr<double> ReadNumber(const std::string& path, const json& fields, const std::string& name) {
  const StatusOr<std::vector<double>> numbers = ReadNumbers(path, fields, name);
  if (!numbers.ok()) return numbers.status();
  if (numbers->size() != 1) {
    return Status::Error(path + ": " + name + " has " + std::to_string(numbers->size()) +
                         " numbers, expected 1");
  }
  return numbers->front();
}

StatusOr<Eigen::MatrixXd> ReadMatrix(
    const std::string& path, const json& fields, const std::string& name, int rows, int cols) {
  const StatusOr<std::vector<double>> numbers = ReadNumbers(path, fields, name);
  if (!numbers.ok()) return numbers.status();
  if (numbers->size() != static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols)) {
    return Status::Error(path + ": " + name + " has " + std::to_string(numbers->size()) +
                         " numbers, expected " + std::to_string(rows) + " x " +
                         std::to_string(cols));
  }
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::MatrixXd(Eigen::Map<const RowMajor>(numbers->data(), rows, cols));
}

void SetIntrinsics(const Eigen::MatrixXd& matrix, PinholeCamera* camera) {
  camera->fx = matrix(0, 0);
  camera->fy = matrix(1, 1);
  camera->cx = matrix(0, 2);
  camera->cy = matrix(1, 2);
}

Status SetSize(const std::string& path, double width, double height, PinholeCamera* camera) {
  constexpr double kLargest = 65535.0;
  for (const double size : {width, height}) {
    if (!(size >= 1.0 && size <= kLargest && size == std::floor(size))) {
      return Status::Error(path + ": a size of the pictures is " + std::to_string(size) +
                           ", expected a whole number of pixels from 1 to 65535");
    }
  }
  camera->width = static_cast<int>(width);
  camera->height = static_cast<int>(height);
  return Status::Ok();
}

Status ReadDistortion(const std::string& path,
                      const json& fields,
                      const std::string& name,
                      LensCamera* camera) {
  const StatusOr<std::vector<double>> numbers = ReadNumbers(path, fields, name);
  if (!numbers.ok()) return numbers.status();
  for (std::size_t i = 0; i < numbers->size(); ++i) {
    if (i < camera->distortion.size()) {
      camera->distortion[i] = (*numbers)[i];
    } else if ((*numbers)[i] != 0.0) {
      return Status::Error(path + ": " + name + " has " + std::to_string(numbers->size()) +
                           " coefficients, expected at most 8: k1 k2 p1 p2 k3 k4 k5 k6");
    }
  }
  return Status::Ok();
}

Status FinishRig(const std::string& path,
                 const Eigen::Matrix3d& rotation,
                 const Eigen::Vector3d& translation,
                 StereoCalibration* calibration) {
  StereoRig& rig = calibration->rig;
  Status status = CheckCamera(path, "left", rig.left.pinhole);
  if (status.ok()) status = CheckCamera(path, "right", rig.right.pinhole);
  if (!status.ok()) return status;
  constexpr double kRounding = 1e-3;
  const bool is_rotation =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <=
          kRounding &&
      rotation.determinant() > 0.0;
  if (!is_rotation) {
    return Status::Error(path +
                         ": the matrix from the left to the right camera is no rotation, "
                         "expected orthogonal rows and determinant 1");
  }
  const double length = translation.norm();
  if (!(length > 0.0)) {
    return Status::Error(path +
                         ": the translation from the left to the right camera is 0, "
                         "expected the baseline");
  }
  const bool is_metres = length < kFirstMillimetre;
  std::ostringstream remark;
  remark << path << ": the baseline of " << std::setprecision(4) << length << " is taken as "
         << (is_metres ? "metres" : "millimetres");
  calibration->remarks.push_back(remark.str());
  rig.right_from_left.rotation = Eigen::Quaterniond(rotation).normalized();
  rig.right_from_left.translation = is_metres ? translation : translation / kMillimetresPerMetre;
  if (translation.x() > 0.0) {
    rig.right_from_left = rig.right_from_left.Inverse();
    calibration->remarks.push_back(
        path + ": the transform places the right camera to the left of the left one, so it is " +
        "taken as the transform from right to left");
  }
  return Status::Ok();
}

Status FinishRectifiedRig(const std::string& path,
                          const Eigen::MatrixXd& left,
                          const Eigen::MatrixXd& right,
                          StereoCalibration* calibration) {
  calibration->is_rectified = true;
  const double x = right(0, 3) / right(0, 0) - left(0, 3) / left(0, 0);
  if (!std::isfinite(x)) {
    return Status::Error(path + ": a focal length is 0, expected a positive number of pixels");
  }
  // Rectified cameras differ in cx only; what rounding has left is removed.
  PinholeCamera& right_camera = calibration->rig.right.pinhole;
  const PinholeCamera& left_camera = calibration->rig.left.pinhole;
  constexpr double kRounding = 1e-3;
  if (std::abs(right_camera.fx - left_camera.fx) > kRounding * left_camera.fx ||
      std::abs(right_camera.fy - left_camera.fy) > kRounding * left_camera.fy ||
      std::abs(right_camera.cy - left_camera.cy) > 1.0) {
    return Status::Error(path +
                         ": focal length or cy of the left and the right camera differ, "
                         "expected rectified cameras, which differ in cx alone");
  }
  right_camera.fx = left_camera.fx;
  right_camera.fy = left_camera.fy;
  right_camera.cy = left_camera.cy;
  return FinishRig(path, Eigen::Matrix3d::Identity(), {x, 0.0, 0.0}, calibration);
}

}  // namespace ceres_ed
