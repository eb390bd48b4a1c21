// Text files about a depth camera: its intrinsics and its poses.
#ifndef CERES_ED_IO_CAMERA_IO_H_
#define CERES_ED_IO_CAMERA_IO_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// The contents of camera.txt: `fx fy cx cy width height depth_units_per_metre`, with # comments.
struct CameraFile {
  PinholeCamera camera;
  // The number of stored depth units in a metre, > 0: metres = stored depth /
  // depth_units_per_metre.
  double depth_units_per_metre = 0.0;
};

// Reads the seven numbers of a camera file, which may be on one line or several. Errors name file,
// line, value and what was expected. It is an error if a number is not finite, a focal length or
// the unit is not positive, a size is not a whole number of pixels, or there are fewer or more
// numbers.
StatusOr<CameraFile> ReadCameraFile(const std::string& path);

// Writes a camera file whose numbers are read back as the same doubles. Returns an error if it
// can't be written or if ReadCameraFile() would refuse a number.
Status WriteCameraFile(const std::string& path, const CameraFile& file);

// The camera pose in a frame of a sequence.
struct FramePose {
  int frame = 0;
  // point_in_world = world_from_camera * point_in_camera, metres.
  CameraPose world_from_camera;
};

// Reads the rows `frame tx ty tz qx qy qz qw` of a poses file, in the order of the file, with #
// comments; there may be no rows. The quaternions are normalised. Errors name file, line, value and
// what was expected. It is an error if a row does not have eight numbers, a number is not finite, a
// frame is not a whole number >= 0 or occurs twice, or a quaternion is zero.
StatusOr<std::vector<FramePose>> ReadPosesFile(const std::string& path);

// Writes a poses file. Poses with unit quaternions are read back as the same doubles. Returns an
// error if the file can't be written or if a pose is not finite or not a rotation.
Status WritePosesFile(const std::string& path, const std::vector<FramePose>& poses);

// The camera pose at a time.
struct TimedPose {
  // Seconds since an origin that the sequence chooses.
  double time_s = 0.0;
  // As in FramePose.
  CameraPose world_from_camera;
};

// Reads the rows `timestamp tx ty tz qx qy qz qw` of a TUM trajectory, in the order of the file.
// Times may be repeated or not sorted. Errors are as those of ReadPosesFile().
StatusOr<std::vector<TimedPose>> ReadTrajectory(const std::string& path);

// Writes a TUM trajectory. Errors and precision are as those of WritePosesFile().
Status WriteTrajectory(const std::string& path, const std::vector<TimedPose>& poses);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CAMERA_IO_H_
