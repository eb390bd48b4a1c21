// Fields of calibration files, for the readers of this folder.
#ifndef CERES_ED_IO_CALIBRATION_CALIBRATION_FIELDS_H_
#define CERES_ED_IO_CALIBRATION_CALIBRATION_FIELDS_H_

#include <ceres_ed/io/calibration/stereo_calibration.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace ceres_ed {

// Returns the field `name` of `fields`. A name with dots, such as "Camera.fx", may also be nested:
// "fx" in "Camera".
const nlohmann::json* FindField(const nlohmann::json& fields, const std::string& name);

// Returns the finite numbers of a field: a number, a list, a list of lists, or a map whose `data`
// is a list. The error names `path` and `name`.
StatusOr<std::vector<double>> ReadNumbers(const std::string& path,
                                          const nlohmann::json& fields,
                                          const std::string& name);

// Returns the number of a field.
StatusOr<double> ReadNumber(const std::string& path,
                            const nlohmann::json& fields,
                            const std::string& name);

// Returns a matrix of a field, which has `rows` x `cols` numbers, row by row.
StatusOr<Eigen::MatrixXd> ReadMatrix(const std::string& path,
                                     const nlohmann::json& fields,
                                     const std::string& name,
                                     int rows,
                                     int cols);

// Sets focal lengths and principal point from a camera matrix (3 rows, 3 or 4 columns).
void SetIntrinsics(const Eigen::MatrixXd& matrix, PinholeCamera* camera);

// Sets the size of the pictures. It is an error if width or height is no whole number of pixels.
Status SetSize(const std::string& path, double width, double height, PinholeCamera* camera);

// Sets the distortion from the field `name`: at most 8 numbers, or more if the others are 0.
Status ReadDistortion(const std::string& path,
                      const nlohmann::json& fields,
                      const std::string& name,
                      LensCamera* camera);

// Sets the transform of a rig whose cameras are set: point_in_right = rotation * point_in_left +
// translation, with a translation in metres or millimetres. A translation with x > 0 would place
// the right camera to the left of the left one; it is taken as that of the inverse transform. The
// remarks say so, and which unit was assumed. Checks all of the rig.
Status FinishRig(const std::string& path,
                 const Eigen::Matrix3d& rotation,
                 const Eigen::Vector3d& translation,
                 StereoCalibration* calibration);

// Does the same for rectified cameras with the projection matrices `left` and `right` (3 x 4): the
// baseline is that of P(0, 3) / P(0, 0).
Status FinishRectifiedRig(const std::string& path,
                          const Eigen::MatrixXd& left,
                          const Eigen::MatrixXd& right,
                          StereoCalibration* calibration);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CALIBRATION_CALIBRATION_FIELDS_H_
