// How well the normals of a surface hold it where planes are matched.
#ifndef CERES_ED_REGISTRATION_NORMAL_SPREAD_H_
#define CERES_ED_REGISTRATION_NORMAL_SPREAD_H_

#include <ceres_ed/geometry/surface.h>

namespace ceres_ed {

// Returns the smallest eigenvalue of the mean of n n^T over the area of `surface`, with its unit
// normals n; their signs do not matter. It is the mean squared distance from its planes that a unit
// shift in the least determined direction causes: 1/3 for a sphere, 0 for a flat sheet, which
// slides in its plane for nothing.
double LeastNormalSpread(const Surface& surface);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_NORMAL_SPREAD_H_
