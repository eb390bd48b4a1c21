// Pixels as whole numbers.
#ifndef CERES_ED_GEOMETRY_NEAREST_PIXEL_H_
#define CERES_ED_GEOMETRY_NEAREST_PIXEL_H_

namespace ceres_ed {

// Returns the row or column whose middle is nearest to `coordinate`, which is at least -0.5, as it
// is for all points in a picture. std::lround() would be slower.
inline int NearestPixel(double coordinate) {
  return static_cast<int>(coordinate + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

}  // namespace ceres_ed

#endif  // CERES_ED_GEOMETRY_NEAREST_PIXEL_H_
