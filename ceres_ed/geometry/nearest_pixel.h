// Rounds pixel coordinates to integers.
#ifndef CERES_ED_GEOMETRY_NEAREST_PIXEL_H_
#define CERES_ED_GEOMETRY_NEAREST_PIXEL_H_

namespace ceres_ed {

// Returns the row or column whose centre is nearest to `coordinate`, which must be at least -0.5;
// this holds for all points in an image. std::lround() would be slower.
inline int NearestPixel(double coordinate) {
  return static_cast<int>(coordinate + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_NEAREST_PIXEL_H_
