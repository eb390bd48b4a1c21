// Ratios of the units in which lengths are given.
#ifndef CERES_ED_GEOMETRY_UNIT_RATIO_H_
#define CERES_ED_GEOMETRY_UNIT_RATIO_H_

#include <cmath>
#include <optional>

namespace ceres_ed {

// The ratios between common units: centimetres and millimetres, inches and millimetres, metres and
// centimetres, metres and millimetres.
inline constexpr double kUnitRatios[] = {10.0, 25.4, 100.0, 1000.0};

// Sizes of one body that differ by more than this factor are probably in different units.
inline constexpr double kPlausibleSizeRatio = 3.0;

// Returns the ratio of kUnitRatios, or the inverse of one, from which `ratio` > 0 differs by at
// most a factor of 1.2; nothing if there is none. A body that bends or that is seen in part has
// another size, so that the ratio of two sizes is never exact.
inline std::optional<double> NearestUnitRatio(double ratio) {
  constexpr double kNear = 1.2;
  std::optional<double> nearest;
  double least = std::log(kNear);
  for (const double unit : kUnitRatios) {
    for (const double candidate : {unit, 1.0 / unit}) {
      const double off = std::abs(std::log(ratio / candidate));
      if (off > least) continue;
      least = off;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_UNIT_RATIO_H_
