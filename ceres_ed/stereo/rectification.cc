#include "ceres_ed/stereo/rectification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace ceres_ed {

struct Rectification::Maps {
  struct OfCamera {
    cv::Mat columns;
    cv::Mat rows;
  };
  OfCamera left;
  OfCamera right;
};

namespace {

// The largest difference of fx, fy and cy that pictures said to be rectified may have, in pixels,
// and the largest rotation and sideways translation, in radians and in baselines.
constexpr double kLargestDifference = 1e-3;
constexpr double kLargestAngle = 1e-6;

cv::Mat MatrixOf(const PinholeCamera& camera) {
  return (cv::Mat_<double>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
}

cv::Mat DistortionOf(const LensCamera& camera) {
  cv::Mat distortion(1, static_cast<int>(camera.distortion.size()), CV_64F);
  std::copy(camera.distortion.begin(), camera.distortion.end(), distortion.begin<double>());
  return distortion;
}

std::string Millimetres(const Eigen::Vector3d& metres) {
  char text[96];
  std::snprintf(text,
                sizeof(text),
                "(%.3g, %.3g, %.3g) mm",
                1e3 * metres.x(),
                1e3 * metres.y(),
                1e3 * metres.z());
  return text;
}

Status CheckCamera(const char* name, const LensCamera& camera) {
  std::string error;
  if (!camera.pinhole.IsValid(&error)) {
    return Status::Error("the calibration of the " + std::string(name) + " camera: " + error);
  }
  const bool finite = std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double k) {
    return std::isfinite(k);
  });
  if (finite) return Status::Ok();
  return Status::Error("the distortion of the " + std::string(name) +
                       " camera is not finite, expected numbers");
}

// Returns an error unless the right camera is at the right of the left one.
Status CheckSides(const RigidTransform& right_from_left) {
  const Eigen::Vector3d& t = right_from_left.translation;
  if (!t.allFinite() || !right_from_left.rotation.coeffs().allFinite() || t.norm() == 0.0) {
    return Status::Error("the translation from the left to the right camera is " + Millimetres(t) +
                         ", expected a baseline, such as (-5, 0, 0) mm");
  }
  if (std::abs(t.x()) < std::hypot(t.y(), t.z())) {
    return Status::Error("the translation from the left to the right camera is " + Millimetres(t) +
                         ", expected one mainly along x: the cameras must stand side by side");
  }
  if (t.x() > 0.0) {
    return Status::Error(
        "the translation from the left to the right camera is " + Millimetres(t) +
        ", expected x < 0: either the transform is the other way round (right to left; then invert "
        "it), or left and right are swapped (then swap pictures and cameras)");
  }
  return Status::Ok();
}

// Returns an error unless a rig is as that of rectified pictures must be.
Status CheckRectified(const StereoRig& rig) {
  const PinholeCamera& left = rig.left.pinhole;
  const PinholeCamera& right = rig.right.pinhole;
  const double difference = std::max(
      {std::abs(left.fx - right.fx), std::abs(left.fy - right.fy), std::abs(left.cy - right.cy)});
  const Eigen::Vector3d& t = rig.right_from_left.translation;
  const double angle = Eigen::AngleAxisd(rig.right_from_left.rotation).angle();
  const auto is_zero = [](double k) { return k == 0.0; };
  const bool straight =
      std::all_of(rig.left.distortion.begin(), rig.left.distortion.end(), is_zero) &&
      std::all_of(rig.right.distortion.begin(), rig.right.distortion.end(), is_zero);
  if (difference <= kLargestDifference && angle <= kLargestAngle && straight &&
      std::hypot(t.y(), t.z()) <= kLargestAngle * t.norm()) {
    return Status::Ok();
  }
  return Status::Error(
      "the calibration is not that of rectified pictures, expected the same fx, fy and cy in both "
      "cameras, no distortion, no rotation and a translation along x");
}

// Wraps the pixels of an image without copying them.
cv::Mat Wrap(const ColorImage& image) {
  return {image.height(),
          image.width(),
          CV_8UC3,
          const_cast<std::array<std::uint8_t, 3>*>(image.pixels().data())};
}

cv::Mat Wrap(const MaskImage& image) {
  return {image.height(), image.width(), CV_8UC1, const_cast<std::uint8_t*>(image.pixels().data())};
}

// Returns an error unless a rig can be that of pictures which are rectified, or are to be.
Status CheckRig(const StereoRig& rig, bool is_rectified) {
  Status status = CheckCamera("left", rig.left);
  if (status.ok()) status = CheckCamera("right", rig.right);
  if (status.ok()) status = CheckSides(rig.right_from_left);
  if (status.ok() && is_rectified) status = CheckRectified(rig);
  if (!status.ok()) return status;
  const PinholeCamera& left = rig.left.pinhole;
  const PinholeCamera& right = rig.right.pinhole;
  if (left.width == right.width && left.height == right.height) return Status::Ok();
  return Status::Error("the left camera has " + std::to_string(left.width) + " x " +
                       std::to_string(left.height) + " pixels and the right one " +
                       std::to_string(right.width) + " x " + std::to_string(right.height) +
                       ", expected the same size");
}

// What rectification makes of a camera.
struct RectifiedCamera {
  // From the coordinates of the given camera to those of the rectified one, 3 x 3.
  cv::Mat turn;
  // The rectified projection, 3 x 4.
  cv::Mat projection;
};

// Turns both cameras so that they look along one direction, at right angles to the baseline.
// Throws what OpenCV throws.
void TurnCameras(const StereoRig& rig, RectifiedCamera* left, RectifiedCamera* right) {
  const Eigen::Matrix3d r = rig.right_from_left.rotation.toRotationMatrix();
  const Eigen::Vector3d& t = rig.right_from_left.translation;
  cv::Mat rotation(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation.at<double>(i, j) = r(i, j);
  }
  const cv::Mat translation = (cv::Mat_<double>(3, 1) << t.x(), t.y(), t.z());
  cv::Mat disparity_to_depth;
  // Without CALIB_ZERO_DISPARITY the principal points may differ, which keeps more of both
  // pictures.
  cv::stereoRectify(MatrixOf(rig.left.pinhole),
                    DistortionOf(rig.left),
                    MatrixOf(rig.right.pinhole),
                    DistortionOf(rig.right),
                    {rig.left.pinhole.width, rig.left.pinhole.height},
                    rotation,
                    translation,
                    left->turn,
                    right->turn,
                    left->projection,
                    right->projection,
                    disparity_to_depth,
                    /*flags=*/0);
}

// Fills in where the pixels of a rectified picture lie in the given one. Throws what OpenCV throws.
void MakeMaps(const LensCamera& camera,
              const RectifiedCamera& rectified,
              cv::Mat* columns,
              cv::Mat* rows) {
  cv::initUndistortRectifyMap(MatrixOf(camera.pinhole),
                              DistortionOf(camera),
                              rectified.turn,
                              rectified.projection,
                              {camera.pinhole.width, camera.pinhole.height},
                              CV_16SC2,
                              *columns,
                              *rows);
}

// Returns the camera and geometry of the rectified pictures.
RectifiedRig RigOf(const StereoRig& rig,
                   const RectifiedCamera& left,
                   const RectifiedCamera& right) {
  const auto projection = [&](int row, int column) {
    return left.projection.at<double>(row, column);
  };
  RectifiedRig rectified;
  rectified.camera = {projection(0, 0),
                      projection(1, 1),
                      projection(0, 2),
                      projection(1, 2),
                      rig.left.pinhole.width,
                      rig.left.pinhole.height};
  rectified.baseline = rig.right_from_left.translation.norm();
  rectified.offset = projection(0, 2) - right.projection.at<double>(0, 2);
  Eigen::Matrix3d turn;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) turn(i, j) = left.turn.at<double>(i, j);
  }
  rectified.rectified_from_left.rotation = Eigen::Quaterniond(turn).normalized();
  return rectified;
}

}  // namespace

Rectification::Rectification() = default;
Rectification::~Rectification() = default;

StatusOr<std::unique_ptr<Rectification>> Rectification::Create(const StereoRig& rig,
                                                               bool is_rectified) {
  if (Status status = CheckRig(rig, is_rectified); !status.ok()) return status;
  std::unique_ptr<Rectification> result(new Rectification);
  if (is_rectified) {
    result->rig_.camera = rig.left.pinhole;
    result->rig_.baseline = -rig.right_from_left.translation.x();
    result->rig_.offset = rig.left.pinhole.cx - rig.right.pinhole.cx;
    return StatusOr<std::unique_ptr<Rectification>>(std::move(result));
  }
  RectifiedCamera left;
  RectifiedCamera right;
  auto maps = std::make_unique<Maps>();
  try {
    TurnCameras(rig, &left, &right);
    MakeMaps(rig.left, left, &maps->left.columns, &maps->left.rows);
    MakeMaps(rig.right, right, &maps->right.columns, &maps->right.rows);
  } catch (const std::exception& error) {
    return Status::Error(std::string("the calibration can't be used for rectification: ") +
                         error.what());
  }
  result->rig_ = RigOf(rig, left, right);
  std::string error;
  if (!result->rig_.camera.IsValid(&error)) {
    return Status::Error("the rectified camera is not usable: " + error);
  }
  result->maps_ = std::move(maps);
  return StatusOr<std::unique_ptr<Rectification>>(std::move(result));
}

RectifiedPair Rectification::Apply(const ColorImage& left,
                                   const ColorImage& right,
                                   const MaskImage& mask) const {
  const PinholeCamera& camera = rig_.camera;
  const MaskImage all(camera.width, camera.height, 255);
  if (maps_ == nullptr) return {left, right, mask.empty() ? all : mask, all};
  RectifiedPair pair;
  pair.left = pair.right = ColorImage(camera.width, camera.height);
  pair.left_mask = pair.right_mask = MaskImage(camera.width, camera.height);
  const auto remap = [](const auto& from, const Maps::OfCamera& maps, auto* to) {
    cv::Mat target = Wrap(*to);
    cv::remap(Wrap(from), target, maps.columns, maps.rows, cv::INTER_LINEAR);
  };
  // A pixel counts if all pixels from which it is interpolated do.
  const auto remap_mask = [&](const MaskImage& from, const Maps::OfCamera& maps, MaskImage* to) {
    MaskImage full = from;
    for (std::uint8_t& pixel : full.pixels()) pixel = pixel != 0 ? 255 : 0;
    remap(full, maps, to);
    for (std::uint8_t& pixel : to->pixels()) pixel = pixel == 255 ? 255 : 0;
  };
  remap(left, maps_->left, &pair.left);
  remap(right, maps_->right, &pair.right);
  remap_mask(mask.empty() ? all : mask, maps_->left, &pair.left_mask);
  remap_mask(all, maps_->right, &pair.right_mask);
  return pair;
}

}  // namespace ceres_ed
