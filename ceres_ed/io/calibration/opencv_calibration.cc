#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/json_file.h>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

using nlohmann::json;

Status ReadCamera(const std::string& path, const json& file, int number, LensCamera* camera) {
  const std::string suffix = std::to_string(number);
  const StatusOr<Eigen::MatrixXd> matrix = ReadMatrix(path, file, "M" + suffix, 3, 3);
  if (!matrix.ok()) return matrix.status();
  SetIntrinsics(*matrix, &camera->pinhole);
  Status status = ReadDistortion(path, file, "D" + suffix, camera);
  if (!status.ok() || FindField(file, "Camera.width") == nullptr) return status;
  const StatusOr<double> width = ReadNumber(path, file, "Camera.width");
  if (!width.ok()) return width.status();
  const StatusOr<double> height = ReadNumber(path, file, "Camera.height");
  if (!height.ok()) return height.status();
  return SetSize(path, *width, *height, &camera->pinhole);
}

}  // namespace

StatusOr<StereoCalibration> ReadOpenCvCalibration(const std::string& path) {
  const StatusOr<json> file = ReadYamlFile(path);
  if (!file.ok()) return file.status();
  StereoCalibration calibration;
  Status status = ReadCamera(path, *file, 1, &calibration.rig.left);
  if (status.ok()) status = ReadCamera(path, *file, 2, &calibration.rig.right);
  if (!status.ok()) return status;
  const StatusOr<Eigen::MatrixXd> rotation = ReadMatrix(path, *file, "R", 3, 3);
  if (!rotation.ok()) return rotation.status();
  const StatusOr<Eigen::MatrixXd> translation = ReadMatrix(path, *file, "T", 3, 1);
  if (!translation.ok()) return translation.status();
  status = FinishRig(path, *rotation, *translation, &calibration);
  if (!status.ok()) return status;
  return calibration;
}

}  // namespace ceres_ed
