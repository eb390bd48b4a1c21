#include <ceres_ed/geometry/normals.h>
#include <ceres_ed/geometry/point_borders.h>

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

TEST(FindBorderPoints, FindsTheRimOfASheet) {
  constexpr int kSide = 20;
  const PointCloud sheet = MakeGridMesh(kSide, kSide);
  const std::vector<char> is_border = FindBorderPoints(sheet.points, ComputeVertexNormals(sheet));
  for (int p = 0; p < kSide * kSide; ++p) {
    const int row = p / kSide;
    const int column = p % kSide;
    const int inside = std::min({row, column, kSide - 1 - row, kSide - 1 - column});
    if (inside == 0) {
      EXPECT_EQ(is_border[p], 1) << p;
    } else if (inside > 1) {
      EXPECT_EQ(is_border[p], 0) << p;
    }
  }
}

TEST(FindBorderPoints, FindsNoneOnAClosedSurface) {
  const PointCloud sphere = MakeSphereMesh(4);
  const std::vector<char> is_border = FindBorderPoints(sphere.points, ComputeVertexNormals(sphere));
  EXPECT_EQ(std::count(is_border.begin(), is_border.end(), 1), 0);
}

TEST(FindBorderPoints, TakesAnyPoints) {
  EXPECT_TRUE(FindBorderPoints({}, {}).empty());
  const std::vector<Eigen::Vector3d> same(5, Eigen::Vector3d::Ones());
  const std::vector<Eigen::Vector3d> normals(5, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(FindBorderPoints(same, normals), std::vector<char>(5, 0));
}

}  // namespace
}  // namespace ceres_ed
