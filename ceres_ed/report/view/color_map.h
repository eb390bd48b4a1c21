// The colours of scalar fields: one table for pages and pictures.
#ifndef CERES_ED_REPORT_VIEW_COLOR_MAP_H_
#define CERES_ED_REPORT_VIEW_COLOR_MAP_H_

#include <array>
#include <cstdint>
#include <vector>

namespace ceres_ed {

using Rgb = std::array<std::uint8_t, 3>;

// Which colours a field has.
enum class ColorScale {
  // From 0 upwards: dark violet over green to yellow, and brighter all the way.
  kMagnitude,
  // Around 0: blue below, almost white at 0, red above.
  kSigned,
};

// Points of which nothing is known.
inline constexpr Rgb kUnknownColor = {150, 150, 150};

// The number of colours in a table.
inline constexpr int kNumColors = 256;

// Returns the kNumColors colours of a scale, from the lowest value to the highest. People who do
// not tell red from green tell them apart, too.
const std::vector<Rgb>& ColorTable(ColorScale scale);

// Returns the colour at `part` of the range: 0 is its low end and 1 its high one; beyond them are
// the colours of the ends. NaN has kUnknownColor.
Rgb ColorAt(ColorScale scale, double part);

}  // namespace ceres_ed

#endif  // CERES_ED_REPORT_VIEW_COLOR_MAP_H_
