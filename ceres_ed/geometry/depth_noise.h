// How uncertain measured depth is.
#ifndef CERES_ED_GEOMETRY_DEPTH_NOISE_H_
#define CERES_ED_GEOMETRY_DEPTH_NOISE_H_

#include <cmath>

namespace ceres_ed {

// The standard deviation of a pixel's depth z, which grows with z:
//
//   sigma_z(z) = sqrt(constant^2 + (quadratic z^2)^2)
//
// For a stereo camera of focal length f (pixels) and baseline b, quadratic = sigma_d / (f b), where
// sigma_d is the standard deviation of the disparity in pixels: z = f b / d, so that
// |dz / dd| = z^2 / (f b). If both members are 0, the noise is not known.
struct DepthNoise {
  // In the unit of the depth.
  double constant = 0.0;
  // Per unit of the depth.
  double quadratic = 0.0;

  bool known() const { return constant > 0.0 || quadratic > 0.0; }
  // Returns the standard deviation at depth z.
  double At(double z) const { return std::hypot(constant, quadratic * z * z); }
  // Returns the noise of the depth multiplied by `scale` > 0.
  DepthNoise Scaled(double scale) const { return {constant * scale, quadratic / scale}; }
};

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_DEPTH_NOISE_H_
