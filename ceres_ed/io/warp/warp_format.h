// The names and sizes in a warp file, which its reader and its writer share.
#ifndef CERES_ED_IO_WARP_WARP_FORMAT_H_
#define CERES_ED_IO_WARP_WARP_FORMAT_H_

#include <cstddef>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

inline constexpr const char* kWarpFormat = "ceres_ed_warp";
// The version that is written, and the newest that is read.
inline constexpr int kWarpVersion = 1;
// The values of "binding.distance".
inline constexpr const char* kSurfaceRule = "surface";
inline constexpr const char* kEuclideanRule = "euclidean";
// The number of values of a node's "A".
inline constexpr std::size_t kWarpAffineSize = kNodeTranslationOffset;

}  // namespace ceres_ed

#endif  // CERES_ED_IO_WARP_WARP_FORMAT_H_
