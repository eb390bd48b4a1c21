#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/json_file.h>

#include <Eigen/Core>

namespace ceres_ed {
namespace {

using nlohmann::json;

// Returns the first of two names that is a field.
std::string Either(const json& file, const char* name, const char* other) {
  return FindField(file, name) != nullptr ? name : other;
}

StatusOr<Eigen::MatrixXd> ReadCamera(const std::string& path, PinholeCamera* camera) {
  const StatusOr<json> file = ReadYamlFile(path);
  if (!file.ok()) return file.status();
  StatusOr<Eigen::MatrixXd> projection =
      ReadMatrix(path, *file, Either(*file, "P", "projection_matrix"), 3, 4);
  if (!projection.ok()) return projection.status();
  SetIntrinsics(*projection, camera);
  const StatusOr<double> width = ReadNumber(path, *file, Either(*file, "width", "image_width"));
  if (!width.ok()) return width.status();
  const StatusOr<double> height = ReadNumber(path, *file, Either(*file, "height", "image_height"));
  if (!height.ok()) return height.status();
  Status status = SetSize(path, *width, *height, camera);
  if (!status.ok()) return status;
  return projection;
}

}  // namespace

StatusOr<StereoCalibration> ReadRosCalibration(const std::string& left_path,
                                               const std::string& right_path) {
  StereoCalibration calibration;
  const StatusOr<Eigen::MatrixXd> left = ReadCamera(left_path, &calibration.rig.left.pinhole);
  if (!left.ok()) return left.status();
  const StatusOr<Eigen::MatrixXd> right = ReadCamera(right_path, &calibration.rig.right.pinhole);
  if (!right.ok()) return right.status();
  Status status = FinishRectifiedRig(right_path, *left, *right, &calibration);
  if (!status.ok()) return status;
  return calibration;
}

}  // namespace ceres_ed
