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
// A level of a template with a smaller share of its pixels shows nothing.
constexpr float kLeastShare = 0.25f;

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

// Subtracts the mean of those values that are `known` (1, otherwise 0), sets the others to 0, and
// divides by the norm. Returns false if there is too little contrast.
template <typename Values>
bool Normalize(const Values& known, float num_known, Values* values) {
  *values -= (*values * known).sum() / num_known;
  *values *= known;
  const float norm = std::sqrt(values->square().sum());
  if (!(norm >= kLeastContrast * std::sqrt(num_known))) return false;
  *values /= norm;
  return true;
}

// Samples a picture at the pixels of a template around `pixel`. Returns false if a part of it lies
// outside of the picture.
bool Look(ImageView<std::uint8_t> image,
          const Eigen::Vector2d& pixel,
          const Eigen::Matrix2d& now_from_then,
          Samples* values) {
  // The corners of a parallelogram bound it.
  for (const double x : {-kRadius, kRadius}) {
    for (const double y : {-kRadius, kRadius}) {
      const Eigen::Vector2d corner = pixel + now_from_then * Eigen::Vector2d(x, y);
      if (!Inside(image, corner.x(), corner.y())) return false;
    }
  }
  const Eigen::Vector2f middle = pixel.cast<float>();
  const Eigen::Matrix2f map = now_from_then.cast<float>();
  // In three loops, of which the compiler can vectorise the first and the last: the places, the
  // pixels, and the interpolation.
  std::array<float, kCount> a, b;
  std::array<int, kCount> first, above, below;
  for (int y = 0; y < kWidth; ++y) {
    const float u0 = middle.x() + map(0, 1) * static_cast<float>(y - kRadius);
    const float v0 = middle.y() + map(1, 1) * static_cast<float>(y - kRadius);
    for (int x = 0; x < kWidth; ++x) {
      const float u = u0 + map(0, 0) * static_cast<float>(x - kRadius);
      const float v = v0 + map(1, 0) * static_cast<float>(x - kRadius);
      const int i = static_cast<int>(u);
      const int j = static_cast<int>(v);
      const int k = y * kWidth + x;
      a[k] = u - static_cast<float>(i);
      b[k] = v - static_cast<float>(j);
      first[k] = j * image.width() + i;
    }
  }
  for (int k = 0; k < kCount; ++k) {
    // Two neighbours in one number.
    const std::uint8_t* row = image.pixels() + first[k];
    const std::uint8_t* next = row + image.width();
    above[k] = row[0] | row[1] << 8;
    below[k] = next[0] | next[1] << 8;
  }
  const auto between = [](int pair, float share) {
    const auto left = static_cast<float>(pair & 255);
    return left + share * (static_cast<float>(pair >> 8) - left);
  };
  for (int k = 0; k < kCount; ++k) {
    const float top = between(above[k], a[k]);
    (*values)[k] = top + b[k] * (between(below[k], a[k]) - top);
  }
  return true;
}

// Every second sample of a template in each direction, normalized, and which of them belong to it.
struct ThinTemplate {
  ThinSamples values;
  ThinSamples known;
  float num_known = 0.0f;
};

// One level of a template: normalized values, their gradients, and the inverse of the normal matrix
// of a shift. All are 0 at pixels that do not belong to it.
class LevelTemplate {
 public:
  LevelTemplate(const PatchTemplate& patch, int level) {
    constexpr int kSide = PatchTemplate::kSide;
    const auto pixel = [&](int x, int y) {
      return patch.levels[level][(y + kRadius + 1) * kSide + x + kRadius + 1];
    };
    const auto slope = [](std::uint8_t low, std::uint8_t high) {
      if (low == PatchTemplate::kOther || high == PatchTemplate::kOther) return 0.0f;
      return 0.5f * (static_cast<float>(high) - static_cast<float>(low));
    };
    int k = 0;
    for (int y = -kRadius; y <= kRadius; ++y) {
      for (int x = -kRadius; x <= kRadius; ++x, ++k) {
        values_[k] = static_cast<float>(pixel(x, y));
        known_[k] = pixel(x, y) != PatchTemplate::kOther ? 1.0f : 0.0f;
        dx_[k] = known_[k] * slope(pixel(x - 1, y), pixel(x + 1, y));
        dy_[k] = known_[k] * slope(pixel(x, y - 1), pixel(x, y + 1));
      }
    }
    num_known_ = known_.sum();
    if (num_known_ < kLeastShare * kCount) return;
    const float mean = (values_ * known_).sum() / num_known_;
    const float norm = std::sqrt(((values_ - mean) * known_).square().sum());
    if (!Normalize(known_, num_known_, &values_)) return;
    dx_ /= norm;
    dy_ /= norm;
    Eigen::Matrix2d normal_matrix;
    const double mixed = static_cast<double>((dx_ * dy_).sum());
    normal_matrix << static_cast<double>(dx_.square().sum()), mixed, mixed,
        static_cast<double>(dy_.square().sum());
    normal_matrix.computeInverseWithCheck(inverse_, valid_, 1e-9);
  }

  bool valid() const { return valid_; }

  ThinTemplate Thin() const {
    ThinTemplate thin;
    int k = 0;
    for (int y = 0; y < kWidth; y += 2) {
      for (int x = 0; x < kWidth; x += 2, ++k) {
        thin.values[k] = values_[y * kWidth + x];
        thin.known[k] = known_[y * kWidth + x];
      }
    }
    thin.num_known = thin.known.sum();
    // The values are normalized already, so that this has no least contrast.
    thin.values -= (thin.values * thin.known).sum() / std::max(1.0f, thin.num_known);
    thin.values *= thin.known;
    const float norm = std::sqrt(thin.values.square().sum());
    if (norm > 0.0f) thin.values /= norm;
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
      if (!Look(image, *pixel, now_from_then, &samples)) return -1.0;
      if (!Normalize(known_, num_known_, &samples)) return -1.0;
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
  // 1 for a pixel that belongs to the template, otherwise 0.
  Samples known_;
  float num_known_ = 0.0f;
  Samples dx_;
  Samples dy_;
  Eigen::Matrix2d inverse_ = Eigen::Matrix2d::Zero();
  bool valid_ = false;
};

// A piece of a picture as numbers, relative to the middle grey, because squares of them are summed.
// It continues to the right of the picture, so that vectors of kLanes pixels can be read.
class GrayWindow {
 public:
  static constexpr int kLanes = 8;
  static constexpr int kMostSide = 64;

  // Copies the columns [u0, u1] and rows [v0, v1], which lie in the picture. Returns false if these
  // are too many.
  bool Copy(ImageView<std::uint8_t> image, int u0, int v0, int u1, int v1) {
    u0_ = u0;
    v0_ = v0;
    const int width = u1 - u0 + 1;
    if (width + kLanes > kMostSide || v1 - v0 >= kMostSide) return false;
    for (int v = v0; v <= v1; ++v) {
      const std::uint8_t* row =
          image.pixels() + static_cast<std::ptrdiff_t>(v) * image.width() + u0;
      float* copy = &values_[(v - v0) * kMostSide];
      for (int i = 0; i < width; ++i) copy[i] = static_cast<float>(row[i]) - 128.0f;
      std::fill_n(copy + width, kLanes, 0.0f);
    }
    return true;
  }

  // Returns the values at a pixel and to the right of it.
  const float* At(int u, int v) const { return &values_[(v - v0_) * kMostSide + u - u0_]; }

 private:
  int u0_ = 0;
  int v0_ = 0;
  std::array<float, kMostSide * kMostSide> values_;
};

// The correlations of the coarse template with a picture, with its middle on a grid of pixels. The
// picture is sampled between pixels at the same fractions for all places of the grid, so that each
// pixel of the template is compared with many places at once.
class GridCorrelation {
 public:
  // Computes the correlations at whole pixels around `middle` that are at most `steps` <=
  // kMostSteps away in each direction. Those where a part of the template lies outside of the
  // picture are -1, and so are all if the template is stretched more than about three times.
  GridCorrelation(const ThinTemplate& wanted,
                  ImageView<std::uint8_t> image,
                  const Eigen::Matrix2d& now_from_then,
                  const Eigen::Vector2d& middle,
                  int steps)
      : side_(2 * steps + 1) {
    values_.fill(-1.0f);
    const Eigen::Vector2d reach = kRadius * now_from_then.cwiseAbs().rowwise().sum();
    const Range i = FindRange(middle.x(), reach.x(), image.width(), steps);
    const Range j = FindRange(middle.y(), reach.y(), image.height(), steps);
    if (i.begin >= i.end || j.begin >= j.end) return;
    const Eigen::Vector2d first = middle + Eigen::Vector2d(i.begin - steps, j.begin - steps);
    const Eigen::Vector2d last = middle + Eigen::Vector2d(i.end - 1 - steps, j.end - 1 - steps);
    const Eigen::Vector2i low = (first - reach).array().max(0.0).cast<int>();
    const Eigen::Vector2i high = (last + reach).cast<int>().array() + 1;
    if (!window_.Copy(image,
                      low.x(),
                      low.y(),
                      std::min(high.x(), image.width() - 1),
                      std::min(high.y(), image.height() - 1))) {
      return;
    }
    for (int row = j.begin; row < j.end; ++row) {
      for (int column = i.begin; column < i.end; column += GrayWindow::kLanes) {
        const int count = std::min(i.end - column, GrayWindow::kLanes);
        const Eigen::Vector2d start = middle + Eigen::Vector2d(column - steps, row - steps);
        CorrelateRow(wanted, now_from_then, start, count, &At(column, row));
      }
    }
  }

  float& At(int i, int j) { return values_[j * side_ + i]; }

  static constexpr int kMostSteps = 8;

 private:
  struct Range {
    int begin = 0;
    int end = 0;
  };
  static constexpr int kMostSide = 2 * kMostSteps + 1;
  using Lanes = Eigen::Array<float, GrayWindow::kLanes, 1>;

  // Returns the places at which the template reaches over no border of the picture.
  static Range FindRange(double middle, double reach, int size, int steps) {
    const double first = std::ceil(reach - middle);
    const double last = std::ceil(size - 1.001 - reach - middle) - 1.0;
    Range range;
    if (!(first <= steps && last >= -steps)) return range;
    range.begin = static_cast<int>(std::max<double>(first, -steps)) + steps;
    range.end = static_cast<int>(std::min<double>(last, steps)) + steps + 1;
    return range;
  }

  // Computes the correlations at `count` pixels in a row, from `start` to the right.
  void CorrelateRow(const ThinTemplate& wanted,
                    const Eigen::Matrix2d& now_from_then,
                    const Eigen::Vector2d& start,
                    int count,
                    float* correlations) const {
    Lanes sum = Lanes::Zero(), squares = Lanes::Zero(), product = Lanes::Zero();
    int k = 0;
    for (int y = -kRadius; y <= kRadius; y += 2) {
      for (int x = -kRadius; x <= kRadius; x += 2, ++k) {
        if (wanted.known[k] == 0.0f) continue;
        const Eigen::Vector2d at = start + now_from_then * Eigen::Vector2d(x, y);
        const int u = static_cast<int>(at.x());
        const int v = static_cast<int>(at.y());
        const auto a = static_cast<float>(at.x() - u);
        const auto b = static_cast<float>(at.y() - v);
        const Lanes above = Between(window_.At(u, v), a);
        const Lanes below = Between(window_.At(u, v + 1), a);
        const Lanes value = above + b * (below - above);
        sum += value;
        squares += value * value;
        product += value * wanted.values[k];
      }
    }
    const float size = std::max(1.0f, wanted.num_known);
    const Lanes variance = (squares - sum * sum / size) / size;
    for (int i = 0; i < count; ++i) {
      if (variance[i] < kLeastContrast * kLeastContrast) continue;
      // The sum of what is wanted is 0.
      correlations[i] = product[i] / std::sqrt(variance[i] * size);
    }
  }

  static Lanes Between(const float* row, float share) {
    const Eigen::Map<const Lanes> left(row), right(row + 1);
    return left + share * (right - left);
  }

  int side_;
  std::array<float, kMostSide * kMostSide> values_;
  GrayWindow window_;
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
  const int steps = std::min(static_cast<int>(std::ceil(0.5 * reach)), GridCorrelation::kMostSteps);
  const int side = 2 * steps + 1;
  GridCorrelation correlation(coarse.Thin(), image, now_from_then, *pixel, steps);
  int best_i = 0, best_j = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      if (correlation.At(i, j) <= correlation.At(best_i, best_j)) continue;
      best_i = i;
      best_j = j;
    }
  }
  const float best = correlation.At(best_i, best_j);
  if (best <= -1.0f) return false;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const bool apart = std::abs(i - best_i) >= kApart || std::abs(j - best_j) >= kApart;
      if (apart && correlation.At(i, j) > kNearlyAsGood * best) return false;
    }
  }
  *pixel += Eigen::Vector2d(best_i - steps, best_j - steps);
  return true;
}

// Moves `pixel` to where the template is found at half resolution, which may be `reach` away.
bool FindCoarsely(const PatchTemplate& patch,
                  ImageView<std::uint8_t> image,
                  const Eigen::Matrix2d& now_from_then,
                  double reach,
                  Eigen::Vector2d* pixel) {
  const LevelTemplate coarse(patch, 1);
  // What shows nothing at half resolution may still be seen at the full one, near the start.
  if (!coarse.valid()) return true;
  Eigen::Vector2d at = *pixel / 2.0;
  if (!SearchGrid(coarse, image, now_from_then, reach, &at)) return false;
  if (coarse.Refine(image, now_from_then, &at) < 0.0) return false;
  *pixel = 2.0 * at;
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
        // The smallest value has another meaning.
        patch->levels[level][k] =
            static_cast<std::uint8_t>(std::max(kOther + 1L, std::lround(value)));
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
  if (reach > 0.0 && !FindCoarsely(patch, picture[1], now_from_then, reach, &pixel)) return match;
  match.correlation = fine.Refine(picture[0], now_from_then, &pixel);
  match.pixel = pixel;
  return match;
}

}  // namespace ceres_ed
