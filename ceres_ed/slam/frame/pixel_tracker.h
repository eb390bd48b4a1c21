// Corners followed from picture to picture: pyramidal Lucas-Kanade of OpenCV, which stays inside.
#ifndef CERES_ED_SLAM_FRAME_PIXEL_TRACKER_H_
#define CERES_ED_SLAM_FRAME_PIXEL_TRACKER_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/slam/slam_options.h>

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

// Where a corner went; `found` is false where it was lost.
struct TrackedPixel {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool found = false;
};

// Knows pixels only: the present picture and the one before it.
class PixelTracker {
 public:
  explicit PixelTracker(const PixelTrackerOptions& options);
  ~PixelTracker();

  // The present picture becomes the one before, and `image` the present one.
  void SetImage(ColorView image);

  // Follows pixels of the picture before into the present one. `predicted`: where they are thought
  // to be there.
  std::vector<TrackedPixel> Track(const std::vector<Eigen::Vector2d>& pixels,
                                  const std::vector<Eigen::Vector2d>& predicted) const;

  // Returns at most `count` corners of the present picture where `allowed` (its size) is nonzero,
  // away from those `taken`, strongest first.
  std::vector<Eigen::Vector2d> Detect(const MaskImage& allowed,
                                      const std::vector<Eigen::Vector2d>& taken,
                                      int count) const;

  // Saves the present picture, or loads it in the place of what is there.
  void Exchange(CheckpointArchive* archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_PIXEL_TRACKER_H_
