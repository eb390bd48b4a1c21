#include "ceres_ed/report/view/color_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ceres_ed {
namespace {

// Anchors at equal distances, between which the colours are linear: those of viridis, and a ramp of
// equal lightness on both sides of 0.
constexpr std::array<Rgb, 9> kMagnitudeAnchors = {{{68, 1, 84},
                                                   {71, 44, 122},
                                                   {59, 81, 139},
                                                   {44, 113, 142},
                                                   {33, 144, 141},
                                                   {39, 173, 129},
                                                   {92, 200, 99},
                                                   {170, 220, 50},
                                                   {253, 231, 37}}};
constexpr std::array<Rgb, 9> kSignedAnchors = {{{5, 48, 97},
                                                {33, 102, 172},
                                                {67, 147, 195},
                                                {146, 197, 222},
                                                {242, 242, 242},
                                                {244, 165, 130},
                                                {214, 96, 77},
                                                {178, 24, 43},
                                                {103, 0, 31}}};

std::vector<Rgb> MakeTable(const std::array<Rgb, 9>& anchors) {
  std::vector<Rgb> table(kNumColors);
  for (int i = 0; i < kNumColors; ++i) {
    const double at = i * static_cast<double>(anchors.size() - 1) / (kNumColors - 1);
    const auto below = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
    const double part = at - static_cast<double>(below);
    for (std::size_t c = 0; c < 3; ++c) {
      table[i][c] = static_cast<std::uint8_t>(
          std::lround((1.0 - part) * anchors[below][c] + part * anchors[below + 1][c]));
    }
  }
  return table;
}

}  // namespace

const std::vector<Rgb>& ColorTable(ColorScale scale) {
  static const std::vector<Rgb> magnitude = MakeTable(kMagnitudeAnchors);
  static const std::vector<Rgb> with_sign = MakeTable(kSignedAnchors);
  return scale == ColorScale::kSigned ? with_sign : magnitude;
}

Rgb ColorAt(ColorScale scale, double part) {
  if (std::isnan(part)) return kUnknownColor;
  const double index = std::clamp(part, 0.0, 1.0) * (kNumColors - 1);
  return ColorTable(scale)[static_cast<std::size_t>(std::lround(index))];
}

}  // namespace ceres_ed
