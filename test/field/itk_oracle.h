// ITK, as the judge of files that are made for it.
#ifndef CERES_ED_TEST_FIELD_ITK_ORACLE_H_
#define CERES_ED_TEST_FIELD_ITK_ORACLE_H_

#include <array>
#include <string>
#include <vector>

// ITK brings an Eigen of its own, so no other one may come in here.
namespace ceres_ed {

using ItkPoint = std::array<double, 3>;

// A grid of points (FieldGrid), with the direction row by row.
struct ItkGrid {
  std::array<int, 3> size;
  ItkPoint origin;
  ItkPoint spacing;
  std::array<double, 9> direction;
};

// Whether these tests were built with ITK. Nothing else may be called without it.
bool HaveItk();

// Returns where ITK maps the points: with the displacement field in the image `path`, or with the
// transform in the file `path` (.h5, .tfm). Points and results are in ITK's coordinates. Fails the
// test if ITK can't read the file.
std::vector<ItkPoint> MapByItk(const std::string& path, const std::vector<ItkPoint>& points);

// Returns the grid of the image `path` as ITK reads it.
ItkGrid ReadGridByItk(const std::string& path);

// Writes an image without content on this grid.
void WriteImageByItk(const std::string& path, const ItkGrid& grid);

// Makes an image of a ball around `center`, resamples it on the same grid with the transform in
// `path`, and returns the centre of the ball in the result.
ItkPoint ResampleBallByItk(const std::string& path,
                           const ItkGrid& grid,
                           const ItkPoint& center,
                           double radius);

}  // namespace ceres_ed

#endif  // CERES_ED_TEST_FIELD_ITK_ORACLE_H_
