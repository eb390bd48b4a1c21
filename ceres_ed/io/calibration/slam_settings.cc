#include <ceres_ed/io/calibration/calibration_fields.h>
#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/io/json_file.h>

#include <Eigen/Core>

namespace ceres_ed {

StatusOr<StereoCalibration> ReadSlamSettings(const std::string& path) {
  const StatusOr<nlohmann::json> file = ReadYamlFile(path);
  if (!file.ok()) return file.status();
  StereoCalibration calibration;
  PinholeCamera camera;
  double baseline_times_focal = 0.0;
  const struct {
    const char* name;
    double* value;
  } fields[] = {{"Camera.fx", &camera.fx},
                {"Camera.fy", &camera.fy},
                {"Camera.cx", &camera.cx},
                {"Camera.cy", &camera.cy},
                {"Camera.bf", &baseline_times_focal}};
  for (const auto& field : fields) {
    const StatusOr<double> number = ReadNumber(path, *file, field.name);
    if (!number.ok()) return number.status();
    *field.value = *number;
  }
  if (FindField(*file, "Camera.width") != nullptr) {
    const StatusOr<double> width = ReadNumber(path, *file, "Camera.width");
    if (!width.ok()) return width.status();
    const StatusOr<double> height = ReadNumber(path, *file, "Camera.height");
    if (!height.ok()) return height.status();
    Status size = SetSize(path, *width, *height, &camera);
    if (!size.ok()) return size;
  }
  calibration.rig.left.pinhole = calibration.rig.right.pinhole = camera;
  calibration.is_rectified = true;
  Status status = FinishRig(path,
                            Eigen::Matrix3d::Identity(),
                            {-baseline_times_focal / camera.fx, 0.0, 0.0},
                            &calibration);
  if (!status.ok()) return status;
  return calibration;
}

}  // namespace ceres_ed
