// A noisy target made smooth enough to be followed.
#ifndef CERES_ED_REGISTRATION_DENOISE_H_
#define CERES_ED_REGISTRATION_DENOISE_H_

#include <ceres_ed/geometry/point_cloud.h>
#include <ceres_ed/geometry/surface.h>

namespace ceres_ed {

// A surface whose noise is smoothed.
struct Denoised {
  // The points moved across the surface, with normals of what they now form.
  PointCloud cloud;
  // Length of the smoothing in edges; 0 where there was nothing to do: `cloud` is empty then.
  double length = 0.0;
  // Standard deviation of the noise that is left, in the unit of the surface.
  double noise = 0.0;
};

// Smooths `surface` until its noise of standard deviation `noise` turns normals by about a tenth of
// a radian and no more; where it doesn't do so, nothing is smoothed.
//
// With D the number of neighbours, L the uniform Laplacian and l the length in edges it solves
//   (D / l^4 + L D^-1 L) z = D / l^4 x
// and moves every point by the part of z - x along the normal of z. On a regular mesh of edge h
// (that of the surface without its noise) this leaves 0.465 sigma / l of white noise and turns
// normals by 0.742 sigma / (h l^2): to 7 % from l = 2 on; at l = 1 the factors are 0.57 and 0.52.
Denoised Denoise(const Surface& surface, double noise);

}  // namespace ceres_ed

#endif  // CERES_ED_REGISTRATION_DENOISE_H_
