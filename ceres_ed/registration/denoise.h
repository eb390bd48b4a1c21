// Smooths a noisy target so that it can be fitted.
#ifndef CERES_ED_REGISTRATION_DENOISE_H_
#define CERES_ED_REGISTRATION_DENOISE_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/surface.h>

#include <functional>

namespace ceres_ed {

// A surface whose noise has been smoothed.
struct Denoised {
  // The points, moved across the surface, with the normals of the smoothed surface.
  PointCloud cloud;
  // The length of the smoothing in edges; 0 if no smoothing was needed, in which case `cloud` is
  // empty.
  double length = 0.0;
  // The standard deviation of the remaining noise, in the unit of the surface.
  double noise = 0.0;
};

// Smooths `surface` just so much that its noise, of standard deviation `noise`, rotates normals by
// about a tenth of a radian. If it rotates them by less, nothing is smoothed.
//
// With D the number of neighbours, L the uniform Laplacian and l the length in edges, it solves
//   (D / l^4 + L D^-1 L) z = D / l^4 x
// and moves every point by the component of z - x along the normal of z. On a regular mesh with
// edge h (without the noise) the remaining part of white noise is 0.465 sigma / l, and normals are
// rotated by 0.742 sigma / (h l^2). Both hold to 7 % for l >= 2; at l = 1 the factors are 0.57 and
// 0.52. If `should_stop` returns true, nothing is smoothed.
Denoised Denoise(const Surface& surface,
                 double noise,
                 const std::function<bool()>& should_stop = {});

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_DENOISE_H_
