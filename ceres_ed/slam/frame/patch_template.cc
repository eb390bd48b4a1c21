#include "ceres_ed/slam/frame/patch_template.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace ceres_ed {
namespace {

constexpr int kRadius = PatchTemplate::kRadius;
constexpr int kWidth = 2 * kRadius + 1;
constexpr int kCount = kWidth * kWidth;
// Steps of the refinement on each level, and the size in pixels of one that ends it.
constexpr int kMaxSteps = 12;
constexpr double kSmallStep = 0.05;
// Patches with less contrast than this (standard deviation, grey values) show nothing.
constexpr float kLeastContrast = 2.0f;

using Samples = Eigen::Array<float, kCount, 1>;
using ThinSamples = Eigen::Array<float, (kRadius + 1) * (kRadius + 1), 1>;

// Returns whether a place is inside of the picture, with its neighbours for the interpolation.
bool Inside(ImageView<std::uint8_t> image, double u, double v) {
  return u >= 0.0 && v >= 0.0 && u < image.width() - 1.001 && v < image.height() - 1.001;
}

// Interpolates bilinearly at a place inside of the picture.
float Sample(ImageView<std::uint8_t> image, float u, float v) {
  const int i = static_cast<int>(u);
  const int j = static_cast<int>(v);
  const float a = u - static_cast<float>(i);
  const float b = v - static_cast<float>(j);
  const std::uint8_t* row = image.pixels() + static_cast<std::ptrdiff_t>(j) * image.width() + i;
  const std::uint8_t* next = row + image.width();
  const float above = static_cast<float>(row[0]) + a * static_cast<float>(row[1] - row[0]);
  const float below = static_cast<float>(next[0]) + a * static_cast<float>(next[1] - next[0]);
  return above + b * (below - above);
}

// Subtracts the mean and divides by the norm. Returns false if there is too little contrast.
template <typename Values>
bool Normalize(Values* values) {
  *values -= values->mean();
  const float norm = std::sqrt(values->square().sum());
  if (norm < kLeastContrast * std::sqrt(static_cast<float>(values->size()))) return false;
  *values /= norm;
  return true;
}

// Samples a picture at every `kStep`-th pixel of a template around `pixel`, and normalizes. Returns
// false if that is not possible.
template <int kStep, typename Values>
bool Look(ImageView<std::uint8_t> image,
          const Eigen::Vector2d& pixel,
          const Eigen::Matrix2d& now_from_then,
          Values* values) {
  // The corners of a parallelogram bound it.
  for (const double x : {-kRadius, kRadius}) {
    for (const double y : {-kRadius, kRadius}) {
      const Eigen::Vector2d corner = pixel + now_from_then * Eigen::Vector2d(x, y);
      if (!Inside(image, corner.x(), corner.y())) return false;
    }
  }
  const Eigen::Vector2f middle = pixel.cast<float>();
  const Eigen::Matrix2f map = now_from_then.cast<float>();
  int k = 0;
  for (int y = -kRadius; y <= kRadius; y += kStep) {
    const float u0 = middle.x() + map(0, 1) * static_cast<float>(y);
    const float v0 = middle.y() + map(1, 1) * static_cast<float>(y);
    for (int x = -kRadius; x <= kRadius; x += kStep, ++k) {
      (*values)[k] = Sample(
          image, u0 + map(0, 0) * static_cast<float>(x), v0 + map(1, 0) * static_cast<float>(x));
    }
  }
  return Normalize(values);
}

// One level of a template: normalized values, their gradients, and the inverse of the normal matrix
// of a shift.
class LevelTemplate {
 public:
  LevelTemplate(const PatchTemplate& patch, int level) {
    constexpr int kSide = PatchTemplate::kSide;
    const auto at = [&](int x, int y) {
      return static_cast<float>(patch.levels[level][(y + kRadius + 1) * kSide + x + kRadius + 1]);
    };
    int k = 0;
    for (int y = -kRadius; y <= kRadius; ++y) {
      for (int x = -kRadius; x <= kRadius; ++x, ++k) {
        values_[k] = at(x, y);
        dx_[k] = 0.5f * (at(x + 1, y) - at(x - 1, y));
        dy_[k] = 0.5f * (at(x, y + 1) - at(x, y - 1));
      }
    }
    const float norm = std::sqrt((values_ - values_.mean()).square().sum());
    if (!Normalize(&values_)) return;
    dx_ /= norm;
    dy_ /= norm;
    Eigen::Matrix2d normal_matrix;
    const double mixed = static_cast<double>((dx_ * dy_).sum());
    normal_matrix << static_cast<double>(dx_.square().sum()), mixed, mixed,
        static_cast<double>(dy_.square().sum());
    normal_matrix.computeInverseWithCheck(inverse_, valid_, 1e-9);
  }

  bool valid() const { return valid_; }

  // Returns every second sample in each direction; normalized.
  ThinSamples Thin() const {
    ThinSamples thin;
    int k = 0;
    for (int y = 0; y < kWidth; y += 2) {
      for (int x = 0; x < kWidth; x += 2) thin[k++] = values_[y * kWidth + x];
    }
    Normalize(&thin);
    return thin;
  }

  // Moves `pixel` (of this level) to the best match near it. Returns its correlation.
  double Refine(ImageView<std::uint8_t> image,
                const Eigen::Matrix2d& now_from_then,
                Eigen::Vector2d* pixel) const {
    Samples samples;
    double correlation = -1.0;
    const Eigen::Vector2d start = *pixel;
    for (int step = 0; step < kMaxSteps; ++step) {
      if (!Look<1>(image, *pixel, now_from_then, &samples)) return -1.0;
      correlation = static_cast<double>((samples * values_).sum());
      const Samples error = samples - values_;
      const Eigen::Vector2d shift =
          now_from_then * (inverse_ * Eigen::Vector2d(static_cast<double>((dx_ * error).sum()),
                                                      static_cast<double>((dy_ * error).sum())));
      if (!shift.allFinite()) return -1.0;
      *pixel -= shift;
      // A match farther away than the template reaches would be chance.
      if ((*pixel - start).norm() > kRadius) return -1.0;
      if (shift.norm() < kSmallStep) break;
    }
    return correlation;
  }

 private:
  Samples values_;
  Samples dx_;
  Samples dy_;
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();
  bool valid_ = false;
};

// Moves `pixel` of the half resolution to the point of a grid that looks most like the template.
// Returns false if another place looks nearly as much like it, as in a pattern that repeats.
bool SearchGrid(const LevelTemplate& coarse,
                ImageView<std::uint8_t> image,
                const Eigen::Matrix2d& now_from_then,
                double reach,
                Eigen::Vector2d* pixel) {
  // Places at least so many pixels apart are different places.
  constexpr int kApart = 4;
  constexpr float kNearlyAsGood = 0.8f;
  const int steps = static_cast<int>(std::ceil(0.5 * reach));
  const int side = 2 * steps + 1;
  const Eigen::Vector2d middle = *pixel;
  const ThinSamples wanted = coarse.Thin();
  ThinSamples samples;
  std::vector<float> correlations(static_cast<std::size_t>(side) * side, -1.0f);
  int best = -1;
  for (int k = 0; k < side * side; ++k) {
    const Eigen::Vector2d at = middle + Eigen::Vector2d(k % side - steps, k / side - steps);
    if (!Look<2>(image, at, now_from_then, &samples)) continue;
    correlations[k] = (samples * wanted).sum();
    if (best >= 0 && correlations[k] <= correlations[best]) continue;
    best = k;
    *pixel = at;
  }
  if (best < 0) return false;
  for (int k = 0; k < side * side; ++k) {
    const bool apart =
        std::abs(k % side - best % side) >= kApart || std::abs(k / side - best / side) >= kApart;
    if (apart && correlations[k] > kNearlyAsGood * correlations[best]) return false;
  }
  return true;
}

}  // namespace

bool PatchTemplate::Cut(const GrayLevels& picture,
                        const Eigen::Vector2d& pixel,
                        PatchTemplate* patch) {
  for (int level = 0; level < 2; ++level) {
    const Eigen::Vector2d middle = pixel / (1 << level);
    int k = 0;
    for (int y = -kRadius - 1; y <= kRadius + 1; ++y) {
      for (int x = -kRadius - 1; x <= kRadius + 1; ++x, ++k) {
        const double u = middle.x() + x;
        const double v = middle.y() + y;
        if (!Inside(picture[level], u, v)) return false;
        const float value = Sample(picture[level], static_cast<float>(u), static_cast<float>(v));
        patch->levels[level][k] = static_cast<std::uint8_t>(std::lround(value));
      }
    }
  }
  return true;
}

PatchMatch FindPatch(const PatchTemplate& patch,
                     const GrayLevels& picture,
                     const Eigen::Vector2d& start,
                     const Eigen::Matrix2d& now_from_then,
                     double reach) {
  PatchMatch match;
  match.pixel = start;
  const LevelTemplate fine(patch, 0);
  if (!fine.valid()) return match;
  Eigen::Vector2d pixel = start;
  const LevelTemplate coarse(patch, 1);
  if (reach > 0.0 && coarse.valid()) {
    pixel /= 2.0;
    if (!SearchGrid(coarse, picture[1], now_from_then, reach, &pixel)) return match;
    if (coarse.Refine(picture[1], now_from_then, &pixel) < 0.0) return match;
    pixel *= 2.0;
  }
  match.correlation = fine.Refine(picture[0], now_from_then, &pixel);
  match.pixel = pixel;
  return match;
}

}  // namespace ceres_ed
