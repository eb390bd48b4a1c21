// The look of a place of the tissue, kept from the frame in which it was first seen, and the search
// for it in later pictures.
#ifndef CERES_ED_SLAM_FRAME_PATCH_TEMPLATE_H_
#define CERES_ED_SLAM_FRAME_PATCH_TEMPLATE_H_

#include <ceres_ed/geometry/images.h>

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace ceres_ed {

// A grey picture without the shades of the light, at full and at half resolution. Pixel (u, v) of
// the second level lies at (2 u, 2 v) of the first one.
using GrayLevels = std::array<ImageView<std::uint8_t>, 2>;

// Square cut-outs of both levels of a picture around one place. Pixels that show something else
// than the surface of that place, for example what is behind its rim, do not belong to the
// template: they would pull it along when they move.
struct PatchTemplate {
  // Pixels on each side of the middle, in pixels of the level.
  static constexpr int kRadius = 6;
  // The gradients need one pixel more.
  static constexpr int kSide = 2 * (kRadius + 1) + 1;
  // The distance from the border of the picture at which a template can be cut out of both levels.
  static constexpr int kMargin = 2 * (kRadius + 1) + 1;

  // The value of a pixel that does not belong to the template.
  static constexpr std::uint8_t kOther = 0;

  std::array<std::array<std::uint8_t, kSide * kSide>, 2> levels;

  // Cuts the template out. Returns false if a part of it lies outside of the picture.
  static bool Cut(const GrayLevels& picture, const Eigen::Vector2d& pixel, PatchTemplate* patch);

  // Keeps of a template that was cut out at `pixel` only the pixels of the picture, at full
  // resolution, for which `belongs(pixel)` is true. Returns the share that is left at full
  // resolution.
  template <typename Belongs>
  double Keep(const Eigen::Vector2d& pixel, const Belongs& belongs) {
    int kept = 0;
    for (int level = 0; level < 2; ++level) {
      for (int k = 0; k < kSide * kSide; ++k) {
        const Eigen::Vector2d offset(k % kSide - kRadius - 1, k / kSide - kRadius - 1);
        if (!belongs(Eigen::Vector2d(pixel + offset * (1 << level)))) {
          levels[level][k] = kOther;
        } else if (level == 0) {
          ++kept;
        }
      }
    }
    return static_cast<double>(kept) / (kSide * kSide);
  }
};

// Where a template was found, and how much it looks like the picture there.
struct PatchMatch {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // The correlation with the picture, without offset and scale of the brightness, in [-1, 1].
  double correlation = -1.0;
};

// Searches for `patch` in a picture around `start`, first at half resolution on a grid that reaches
// `reach` in [0, 16] pixels to each side (0: not at all), then by the inverse compositional method
// (Baker and Matthews 2004) at both resolutions. `now_from_then` maps offsets in the picture of the
// template to offsets in this one.
PatchMatch FindPatch(const PatchTemplate& patch,
                     const GrayLevels& picture,
                     const Eigen::Vector2d& start,
                     const Eigen::Matrix2d& now_from_then,
                     double reach);

}  // namespace ceres_ed

#endif  // CERES_ED_SLAM_FRAME_PATCH_TEMPLATE_H_
