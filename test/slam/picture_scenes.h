// Pictures in which every pixel moves by a known amount.
#ifndef CERES_ED_TEST_SLAM_PICTURE_SCENES_H_
#define CERES_ED_TEST_SLAM_PICTURE_SCENES_H_

#include <ceres_ed/geometry/images.h>
#include <ceres_ed/simulation/texture.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace ceres_ed {

// Returns a picture of a textured sheet, 0.5 mm per pixel, shifted by `shift` pixels, under
// light(u, v) in [0, 1] that is fixed in the picture.
template <typename Light>
ColorImage TexturedPicture(const Eigen::Vector2d& shift, const Light& light, int seed = 1) {
  constexpr double kPixel = 0.5e-3;
  const SyntheticTexture texture(seed);
  ColorImage image(160, 120);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const Eigen::Vector3d place(kPixel * (u - shift.x()), kPixel * (v - shift.y()), 0.01);
      const Eigen::Vector3d color = texture.Color(place, kPixel);
      for (int c = 0; c < 3; ++c) {
        image(u, v)[c] = static_cast<std::uint8_t>(
            std::lround(std::clamp(255.0 * light(u, v) * color[c], 0.0, 255.0)));
      }
    }
  }
  return image;
}

inline double EvenLight(double, double) { return 1.0; }

// The light of a lamp at the camera, which leaves the corners dark.
inline double LampLight(double u, double v) {
  const double x = (u - 79.5) / 45.0;
  const double y = (v - 59.5) / 45.0;
  return 0.15 + 0.85 * std::exp(-(x * x + y * y));
}

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_SLAM_PICTURE_SCENES_H_
