#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/json_file.h>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

using nlohmann::json;

Status ReadCamera(const std::string& path,
                  const json& file,
                  const std::string& side,
                  LensCamera* camera) {
  const StatusOr<Eigen::MatrixXd> matrix = ReadMatrix(path, file, side + "cameramat", 3, 3);
  if (!matrix.ok()) return matrix.status();
  SetIntrinsics(*matrix, &camera->pinhole);
  return ReadDistortion(path, file, side + "distortioncoeffs", camera);
}

}  // namespace

StatusOr<StereoCalibration> ReadStirCalibration(const std::string& path) {
  const StatusOr<json> file = ReadJsonFile(path);
  if (!file.ok()) return file.status();
  StereoCalibration calibration;
  Status status = ReadCamera(path, *file, "left", &calibration.rig.left);
  if (status.ok()) status = ReadCamera(path, *file, "right", &calibration.rig.right);
  if (!status.ok()) return status;
  const StatusOr<Eigen::MatrixXd> rotation = ReadMatrix(path, *file, "rotation", 3, 3);
  if (!rotation.ok()) return rotation.status();
  const StatusOr<Eigen::MatrixXd> translation = ReadMatrix(path, *file, "translation", 3, 1);
  if (!translation.ok()) return translation.status();
  status = FinishRig(path, *rotation, *translation, &calibration);
  if (!status.ok()) return status;
  return calibration;
}

}  // namespace ceres_ed
