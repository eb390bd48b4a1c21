// Poses as matrices of 4 x 4 numbers.
#ifndef CERES_ED_IO_POSE_MATRIX_H_
#define CERES_ED_IO_POSE_MATRIX_H_

#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// Returns the pose of a matrix: rotation, and translation / units_per_metre. The error begins with
// `place`: a number is not finite, the rotation is no rotation, or the last row is not 0 0 0 1.
StatusOr<CameraPose> PoseFromMatrix(const std::string& place,
                                    const Eigen::Matrix4d& matrix,
                                    double units_per_metre);

// Reads a file of 16 numbers, row by row, with text after # ignored.
StatusOr<CameraPose> ReadPoseMatrix(const std::string& path, double units_per_metre);

// Reads a file with 16 numbers in each line. In `by_columns`, the translation is the last row.
StatusOr<std::vector<CameraPose>> ReadPoseRows(const std::string& path,
                                               double units_per_metre,
                                               bool by_columns);

// Returns the matrix of a pose, with a translation in metres * units_per_metre.
Eigen::Matrix4d MatrixOfPose(const CameraPose& pose, double units_per_metre);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_POSE_MATRIX_H_
