#include "ceres_ed/slam/frame/pixel_tracker.h"

namespace ceres_ed {

// Finds no corners: depth alone holds the camera and the tissue.
struct PixelTracker::Impl {};

PixelTracker::PixelTracker(const PixelTrackerOptions& /*options*/) {}

PixelTracker::~PixelTracker() = default;

void PixelTracker::SetImage(ColorView /*image*/, const MaskImage& /*measured*/) {}

void PixelTracker::ForgetPrevious() {}

GrayLevels PixelTracker::Levels() const { return {}; }

std::vector<TrackedPixel> PixelTracker::Flow(
    const std::vector<Eigen::Vector2d>& pixels,
    const std::vector<Eigen::Vector2d>& /*predicted*/) const {
  return std::vector<TrackedPixel>(pixels.size());
}

void PixelTracker::CheckReturn(const std::vector<Eigen::Vector2d>& /*pixels*/,
                               const std::vector<Eigen::Vector2d>& /*predicted*/,
                               std::vector<TrackedPixel>* /*tracked*/) const {}

std::vector<Eigen::Vector2d> PixelTracker::Detect(const MaskImage& /*allowed*/,
                                                  const std::vector<Eigen::Vector2d>& /*taken*/,
                                                  int /*count*/) const {
  return {};
}

void PixelTracker::Exchange(CheckpointArchive* /*archive*/) {}

}  // namespace ceres_ed
