// Files that describe a calibrated stereo camera, as programs and data sets write them. Each reader
// has a file of its own in this folder.
//
// A reader fills the size of the pictures where the file gives it; otherwise width and height are
// 0. The baseline is brought to metres: a file does not say its unit, so a translation shorter than
// 0.5 is taken as metres and a longer one as millimetres (endoscopes have 2 to 10 mm, other stereo
// cameras less than half a metre).
//
// Errors name the file, the field, its value and what was expected: the file can't be read, a field
// is missing or has another shape, a number is not finite, a focal length is not positive, or a
// rotation is no rotation.
#ifndef CERES_ED_IO_CALIBRATION_STEREO_CALIBRATION_H_
#define CERES_ED_IO_CALIBRATION_STEREO_CALIBRATION_H_

#include <ceres_ed/geometry/stereo_rig.h>
#include <ceres_ed/util/status.h>

#include <string>
#include <vector>

namespace ceres_ed {

// A stereo camera as read from a file.
struct StereoCalibration {
  StereoRig rig;
  // True if the file describes rectified pictures: rows correspond, and lenses bend nothing.
  bool is_rectified = false;
  // Sentences about what the file does not say and was assumed, each with the name of the file.
  std::vector<std::string> remarks;
};

// Reads StereoCalibration.ini of StereoMIS: sections [StereoLeft] and [StereoRight] with res_x,
// res_y, fc_x, fc_y, cc_x, cc_y, kc_0 to kc_7, and in StereoRight R_0 to R_8 (row by row) and T_0
// to T_2: point_in_right = R point_in_left + T.
StatusOr<StereoCalibration> ReadIniCalibration(const std::string& path);

// Reads camcal.json or camera_calibration.json of StereoMIS: data.intrinsics[0 and 1] with f, c and
// k, data.extrinsics with om (a rotation vector) and T, and data.width and data.height.
StatusOr<StereoCalibration> ReadCamcalCalibration(const std::string& path);

// Reads a YAML file that OpenCV has written: M1, D1, M2, D2, R, T (SCARED, SurgT), and where they
// are there Camera.width and Camera.height.
StatusOr<StereoCalibration> ReadOpenCvCalibration(const std::string& path);

// Reads calib.json of STIR: leftcameramat, rightcameramat, leftdistortioncoeffs,
// rightdistortioncoeffs, rotation, translation.
StatusOr<StereoCalibration> ReadStirCalibration(const std::string& path);

// Reads a pair of camera_info files of ROS, for rectified pictures: image_width (or width),
// image_height, and P (or projection_matrix) of both. The baseline is that of the right P.
StatusOr<StereoCalibration> ReadRosCalibration(const std::string& left_path,
                                               const std::string& right_path);

// Reads a file of Rectified_calibration of SERV-CT: P1 and P2, in pixels and millimetres.
StatusOr<StereoCalibration> ReadServCtCalibration(const std::string& path);

// Reads settings.yaml of NR-SLAM or ORB-SLAM, for rectified pictures: Camera.fx, fy, cx, cy and
// Camera.bf, which is the baseline times fx, and where they are there Camera.width and
// Camera.height.
StatusOr<StereoCalibration> ReadSlamSettings(const std::string& path);

}  // namespace ceres_ed

#endif  // CERES_ED_IO_CALIBRATION_STEREO_CALIBRATION_H_
