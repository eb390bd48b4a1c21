// Tracks corners from picture to picture with the pyramidal Lucas-Kanade method of OpenCV, which
// this header hides.
#ifndef CERES_ED_SLAM_FRAME_PIXEL_TRACKER_H_
#define CERES_ED_SLAM_FRAME_PIXEL_TRACKER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/slam/frame/patch_template.h>
#include <ceres_ed/slam/slam_options.h>

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// The new position of a corner; `found` is false if it was lost.
struct TrackedPixel {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool found = false;
};

// Works on pixels only. It stores the present picture and the previous one.
class PixelTracker {
 public:
  explicit PixelTracker(const PixelTrackerOptions& options);
  ~PixelTracker();

  // Makes the present picture the previous one, and `image` the present one. `measured` is empty,
  // or of its size and not 0 where a surface was measured: the light is then estimated from these
  // pixels alone.
  void SetImage(ColorView image, const MaskImage& measured = MaskImage());

  // Returns the present picture in grey, without the shades of the light. It is valid until the
  // next call of SetImage() or Exchange().
  GrayLevels Levels() const;

  // Tracks pixels of the previous picture into the present one. `predicted` contains their expected
  // positions there. The result is not checked.
  std::vector<TrackedPixel> Flow(const std::vector<Eigen::Vector2d>& pixels,
                                 const std::vector<Eigen::Vector2d>& predicted) const;

  // Checks results of Flow(): those that do not return to their pixel, when they are tracked
  // backward, are lost.
  void CheckReturn(const std::vector<Eigen::Vector2d>& pixels,
                   const std::vector<Eigen::Vector2d>& predicted,
                   std::vector<TrackedPixel>* tracked) const;

  // Tracks pixels by Flow(), and checks them.
  std::vector<TrackedPixel> Track(const std::vector<Eigen::Vector2d>& pixels,
                                  const std::vector<Eigen::Vector2d>& predicted) const {
    std::vector<TrackedPixel> tracked = Flow(pixels, predicted);
    CheckReturn(pixels, predicted, &tracked);
    return tracked;
  }

  // Frees the previous picture, which is the largest part of the memory. From then on, until the
  // next call of SetImage(), nothing is tracked.
  void ForgetPrevious();

  // Returns at most `count` corners of the present picture, strongest first, where `allowed` (of
  // the size of the picture) is non-zero, and at a distance from those `taken`.
  std::vector<Eigen::Vector2d> Detect(const MaskImage& allowed,
                                      const std::vector<Eigen::Vector2d>& taken,
                                      int count) const;

  // Saves the present picture, or loads it and replaces the present one.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_PIXEL_TRACKER_H_
