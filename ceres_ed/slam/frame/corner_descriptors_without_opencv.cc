#include "ceres_ed/slam/frame/corner_descriptors.h"

namespace ceres_ed {

// Describes nothing.
std::vector<CornerDescriptor> DescribeCorners(ImageView<std::uint8_t> /*picture*/,
                                              const std::vector<Eigen::Vector2d>& pixels) {
  return std::vector<CornerDescriptor>(pixels.size(), CornerDescriptor{});
}

std::vector<std::pair<int, int>> MatchDescriptors(const std::vector<CornerDescriptor>& /*a*/,
                                                  const std::vector<CornerDescriptor>& /*b*/) {
  return {};
}

}  // namespace ceres_ed
