// Corners followed from picture to picture: pyramidal Lucas-Kanade of OpenCV, which stays inside.
#ifndef CERES_ED_SLAM_PIXEL_TRACKER_H_
#define CERES_ED_SLAM_PIXEL_TRACKER_H_

#include <ceres_ed/geometry/images.h>

#include <memory>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

class CheckpointArchive;

struct PixelTrackerOptions {
  // Side of the window that is matched, pixels, odd, >= 3.
  int window = 17;
  int pyramid_levels = 3;
  // Shades wider than this are taken for light and removed, pixels, > 0.
  double light_radius = 4.0;
  // A corner tracked forward and back again must return to within this, pixels, > 0.
  double max_round_trip = 0.7;
  // Between two corners, pixels, >= 1.
  double min_distance = 12.0;
  // Strength of the weakest corner relative to the strongest, in (0, 1).
  double quality = 0.005;
  // Corners are followed on so many threads, >= 1; the result doesn't depend on it.
  int num_threads = 1;
};

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

#endif  // CERES_ED_SLAM_PIXEL_TRACKER_H_
