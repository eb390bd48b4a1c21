// What a warp file holds besides its numbers: shared by its reader and its writer.
#ifndef CERES_ED_IO_WARP_WARP_FORMAT_H_
#define CERES_ED_IO_WARP_WARP_FORMAT_H_

#include <cstddef>

#include <cost_functions/node_parameters.h>

namespace ceres_ed {

inline constexpr const char* kWarpFormat = "ceres_ed_warp";
// The one that is written, and the newest that is read.
inline constexpr int kWarpVersion = 1;
// Of "binding.distance".
inline constexpr const char* kSurfaceRule = "surface";
inline constexpr const char* kEuclideanRule = "euclidean";
// Numbers of a node's "A".
inline constexpr std::size_t kWarpAffineSize = kNodeTranslationOffset;

}  // namespace ceres_ed

#endif  // CERES_ED_IO_WARP_WARP_FORMAT_H_
