#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/json_file.h>

#include <Eigen/Core>

namespace ceres_ed {

StatusOr<StereoCalibration> ReadServCtCalibration(const std::string& path) {
  const StatusOr<nlohmann::json> file = ReadJsonFile(path);
  if (!file.ok()) return file.status();
  const StatusOr<Eigen::MatrixXd> left = ReadMatrix(path, *file, "P1", 3, 4);
  if (!left.ok()) return left.status();
  const StatusOr<Eigen::MatrixXd> right = ReadMatrix(path, *file, "P2", 3, 4);
  if (!right.ok()) return right.status();
  StereoCalibration calibration;
  SetIntrinsics(*left, &calibration.rig.left.pinhole);
  SetIntrinsics(*right, &calibration.rig.right.pinhole);
  Status status = FinishRectifiedRig(path, *left, *right, &calibration);
  if (!status.ok()) return status;
  return calibration;
}

}  // namespace ceres_ed
