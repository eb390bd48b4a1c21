// intrinsics.txt: a camera matrix as rows of numbers.
#ifndef CERES_ED_IO_CALIBRATION_CAMERA_MATRIX_H_
#define CERES_ED_IO_CALIBRATION_CAMERA_MATRIX_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/util/status.h>

#include <string>

namespace ceres_ed {

// A camera matrix and the number of its rows.
struct CameraMatrixFile {
  // Width and height are 1: the file does not give them.
  PinholeCamera camera;
  // 3 (rectified Hamlyn) or 4 (DeepDeform).
  int rows = 0;
};

// Reads a matrix of 3 rows of 3 or 4 numbers, or of 4 rows of 4 numbers: fx 0 cx, 0 fy cy, 0 0 1.
// A fourth column of 3 rows belongs to the other camera and is not used. Text after # is ignored.
// Errors name file, line, value and what was expected.
StatusOr<CameraMatrixFile> ReadIntrinsicsFile(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CALIBRATION_CAMERA_MATRIX_H_
