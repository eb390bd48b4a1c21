#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/json_file.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ceres_ed {
namespace {

using nlohmann::json;

Status ReadCamera(const std::string& path, const json& data, int index, LensCamera* camera) {
  const json* list = FindField(data, "intrinsics");
  const auto at = static_cast<std::size_t>(index);
  if (list == nullptr || !list->is_array() || list->size() <= at) {
    return Status::Error(path +
                         ": no data.intrinsics of two cameras, expected a list with f, c, k");
  }
  const StatusOr<Eigen::MatrixXd> focal = ReadMatrix(path, (*list)[at], "f", 2, 1);
  if (!focal.ok()) return focal.status();
  const StatusOr<Eigen::MatrixXd> center = ReadMatrix(path, (*list)[at], "c", 2, 1);
  if (!center.ok()) return center.status();
  PinholeCamera& pinhole = camera->pinhole;
  pinhole.fx = (*focal)(0);
  pinhole.fy = (*focal)(1);
  pinhole.cx = (*center)(0);
  pinhole.cy = (*center)(1);
  const StatusOr<double> width = ReadNumber(path, data, "width");
  if (!width.ok()) return width.status();
  const StatusOr<double> height = ReadNumber(path, data, "height");
  if (!height.ok()) return height.status();
  Status status = SetSize(path, *width, *height, &pinhole);
  return status.ok() ? ReadDistortion(path, (*list)[at], "k", camera) : status;
}

}  // namespace

StatusOr<StereoCalibration> ReadCamcalCalibration(const std::string& path) {
  const StatusOr<json> file = ReadJsonFile(path);
  if (!file.ok()) return file.status();
  const json* data = FindField(*file, "data");
  if (data == nullptr) {
    return Status::Error(path +
                         ": no data, expected intrinsics, extrinsics, width and height in it");
  }
  StereoCalibration calibration;
  Status status = ReadCamera(path, *data, 0, &calibration.rig.left);
  if (status.ok()) status = ReadCamera(path, *data, 1, &calibration.rig.right);
  if (!status.ok()) return status;
  const StatusOr<Eigen::MatrixXd> turn = ReadMatrix(path, *data, "extrinsics.om", 3, 1);
  if (!turn.ok()) return turn.status();
  const StatusOr<Eigen::MatrixXd> translation = ReadMatrix(path, *data, "extrinsics.T", 3, 1);
  if (!translation.ok()) return translation.status();
  const Eigen::Vector3d vector = *turn;
  const double angle = vector.norm();
  const Eigen::Matrix3d rotation = angle > 0.0
                                       ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix()
                                       : Eigen::Matrix3d::Identity();
  status = FinishRig(path, rotation, *translation, &calibration);
  if (!status.ok()) return status;
  return calibration;
}

}  // namespace ceres_ed
