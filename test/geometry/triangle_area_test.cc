#include "ceres_ed/geometry/triangle_area.h"

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(AreaVector, IsNormalToTheTriangleAndAsLongAsItsArea) {
  const std::vector<Eigen::Vector3d> points = {{1, 1, 5}, {3, 1, 5}, {1, 4, 5}};
  EXPECT_EQ(AreaVector(points, {0, 1, 2}), Eigen::Vector3d(0, 0, 3));
  EXPECT_EQ(AreaVector(points, {0, 2, 1}), Eigen::Vector3d(0, 0, -3));
}

TEST(SurfaceArea, IsThatOfAllTrianglesWhateverTheirSide) {
  const std::vector<Eigen::Vector3d> square = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(SurfaceArea(square, {{0, 1, 2}, {0, 3, 2}}), 4.0);
  EXPECT_EQ(SurfaceArea(square, {}), 0.0);
}

}  // namespace
}  // namespace ceres_ed
