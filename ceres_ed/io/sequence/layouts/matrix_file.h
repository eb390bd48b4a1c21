// Text files with the numbers of a matrix.
#ifndef CERES_ED_IO_SEQUENCE_LAYOUTS_MATRIX_FILE_H_
#define CERES_ED_IO_SEQUENCE_LAYOUTS_MATRIX_FILE_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/geometry/rigid_transform.h>
#include <ceres_ed/util/status.h>

#include <array>
#include <string>

#include <Eigen/Core>

namespace ceres_ed {

// Reads a matrix of numbers, one row on each line, with # comments. Errors name file, line, value
// and what was expected: another number of rows or columns, or a number that is not finite.
StatusOr<Eigen::MatrixXd> ReadMatrixFile(const std::string& path, int rows, int columns);

// Reads the rows fx 0 cx, 0 fy cy, 0 0 1. The size of the camera is 1 x 1 then. It is an error if
// the matrix is another one.
StatusOr<PinholeCamera> ReadCameraMatrix(const std::string& path);

// Reads a rigid transform from a matrix of 4 x 4 numbers; its translation is multiplied by `scale`.
// It is an error if the matrix is no rotation (to 1e-3) with a translation.
StatusOr<RigidTransform> ReadTransformMatrix(const std::string& path, double scale);

// Reads 4 to 8 distortion coefficients k1 k2 p1 p2 [k3 [k4 k5 k6]], on one line or several; those
// that are not there are 0.
StatusOr<std::array<double, 8>> ReadDistortionFile(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_SEQUENCE_LAYOUTS_MATRIX_FILE_H_
