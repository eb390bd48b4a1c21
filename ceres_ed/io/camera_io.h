// Text files about a depth camera: its intrinsics and its poses.
#ifndef CERES_ED_IO_CAMERA_IO_H_
#define CERES_ED_IO_CAMERA_IO_H_

#include <ceres_ed/geometry/pinhole_camera.h>
#include <ceres_ed/graph/deformation_state.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// What camera.txt says: `fx fy cx cy width height depth_units_per_metre`, # comments.
struct CameraFile {
  PinholeCamera camera;
  // Stored depth / depth_units_per_metre = metres; > 0.
  double depth_units_per_metre = 0.0;
};

// Returns the seven numbers of a camera file, on one line or several. Errors name file, line, value
// and what was expected: not a finite number, a focal length or a unit that is not positive, a size
// that is no whole number of pixels, fewer numbers or more.
StatusOr<CameraFile> ReadCameraFile(const std::string& path);

// Returns ok when `path` holds the numbers, such that they read back as the same doubles; an error
// when it can't be written or a number is one that ReadCameraFile refuses.
Status WriteCameraFile(const std::string& path, const CameraFile& file);

// Where the camera is in a frame of a sequence.
struct FramePose {
  int frame = 0;
  // point_in_world = world_from_camera * point_in_camera, metres.
  CameraPose world_from_camera;
};

// Returns the rows `frame tx ty tz qx qy qz qw` of a poses file in the order of the file (#
// comments, possibly none). Quaternions come back with unit length. Errors name file, line, value
// and what was expected: a row of other than eight numbers, not finite, a frame that is no whole
// number >= 0 or that is there twice, a quaternion of zeros.
StatusOr<std::vector<FramePose>> ReadPosesFile(const std::string& path);

// Returns ok when `path` holds the poses, such that those of unit length read back as the same
// doubles; an error when it can't be written or a pose is not finite or no rotation.
Status WritePosesFile(const std::string& path, const std::vector<FramePose>& poses);

// Where the camera is at a moment.
struct TimedPose {
  // Seconds since an origin of the sequence's own.
  double time_s = 0.0;
  // As in FramePose.
  CameraPose world_from_camera;
};

// Returns the rows `timestamp tx ty tz qx qy qz qw` of a TUM trajectory in the order of the file,
// times repeated or not sorted too. Errors as of ReadPosesFile.
StatusOr<std::vector<TimedPose>> ReadTrajectory(const std::string& path);

// Writes a TUM trajectory; errors and precision as of WritePosesFile.
Status WriteTrajectory(const std::string& path, const std::vector<TimedPose>& poses);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CAMERA_IO_H_
