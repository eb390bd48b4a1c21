#include "ceres_ed/io/calibration/rectify_rig.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

namespace ceres_ed {
namespace {

cv::Matx33d MatrixOf(const PinholeCamera& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

cv::Mat CoefficientsOf(const LensCamera& camera) {
  return cv::Mat(1,
                 static_cast<int>(camera.distortion.size()),
                 CV_64F,
                 const_cast<double*>(camera.distortion.data()))
      .clone();
}

PinholeCamera CameraOf(const cv::Mat& projection, const PinholeCamera& size) {
  PinholeCamera camera = size;
  camera.fx = projection.at<double>(0, 0);
  camera.fy = projection.at<double>(1, 1);
  camera.cx = projection.at<double>(0, 2);
  camera.cy = projection.at<double>(1, 2);
  return camera;
}

}  // namespace

StereoRig RectifyRig(const StereoRig& rig) {
  const Eigen::Matrix3d rotation = rig.right_from_left.rotation.toRotationMatrix();
  cv::Matx33d turn;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) turn(row, column) = rotation(row, column);
  }
  const Eigen::Vector3d& shift = rig.right_from_left.translation;
  cv::Mat left_turn, right_turn, left_projection, right_projection, reprojection;
  cv::stereoRectify(MatrixOf(rig.left.pinhole),
                    CoefficientsOf(rig.left),
                    MatrixOf(rig.right.pinhole),
                    CoefficientsOf(rig.right),
                    {rig.left.pinhole.width, rig.left.pinhole.height},
                    turn,
                    cv::Vec3d(shift.x(), shift.y(), shift.z()),
                    left_turn,
                    right_turn,
                    left_projection,
                    right_projection,
                    reprojection,
                    cv::CALIB_ZERO_DISPARITY,
                    /*alpha=*/0.0);
  StereoRig rectified;
  rectified.left.pinhole = CameraOf(left_projection, rig.left.pinhole);
  rectified.right.pinhole = CameraOf(right_projection, rig.right.pinhole);
  rectified.right_from_left.translation = {
      right_projection.at<double>(0, 3) / right_projection.at<double>(0, 0), 0.0, 0.0};
  return rectified;
}

}  // namespace ceres_ed
