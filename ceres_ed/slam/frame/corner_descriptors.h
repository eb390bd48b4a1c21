// Descriptors of corners, by which places are recognised without a prediction: ORB of OpenCV, which
// this header hides.
#ifndef CERES_ED_SLAM_FRAME_CORNER_DESCRIPTORS_H_
#define CERES_ED_SLAM_FRAME_CORNER_DESCRIPTORS_H_

#include <ceres_ed/geometry/images.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// 256 comparisons of pixels around a corner, turned by its orientation (Rublee et al., "ORB: an
// efficient alternative to SIFT or SURF", 2011); all zeros for a corner that could not be
// described.
using CornerDescriptor = std::array<std::uint8_t, 32>;

// Describes corners of a grey picture. Corners near its border get zeros.
std::vector<CornerDescriptor> DescribeCorners(ImageView<std::uint8_t> picture,
                                              const std::vector<Eigen::Vector2d>& pixels);

// Returns pairs of indices (a, b) of descriptors that are each other's nearest ones, and clearly
// nearer than the second nearest ones.
std::vector<std::pair<int, int>> MatchDescriptors(const std::vector<CornerDescriptor>& a,
                                                  const std::vector<CornerDescriptor>& b);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_CORNER_DESCRIPTORS_H_
