#include "ceres_ed/geometry/near_copies.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

TEST(NearCopies, AreApartByRoundingOnly) {
  std::vector<Eigen::Vector3d> points = RandomPoints(200, 1);
  EXPECT_FALSE(HasNearCopies(points));
  // Exact copies, also with a negative zero, are one point in every frame.
  points[3].x() = 0.0;
  points.push_back(points[3]);
  points.back().x() = -0.0;
  EXPECT_FALSE(HasNearCopies(points));
  points.back().x() = 1e-14;
  EXPECT_TRUE(HasNearCopies(points));
  points.back().x() = 1e-6;
  EXPECT_FALSE(HasNearCopies(points));
}

TEST(NearCopies, DoNotDependOnTheUnit) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    std::vector<Eigen::Vector3d> points = RandomPoints(50, 2);
    for (Eigen::Vector3d& point : points) point *= unit;
    EXPECT_FALSE(HasNearCopies(points)) << unit;
    points.push_back(points[7] * (1.0 + 1e-15));
    EXPECT_TRUE(HasNearCopies(points)) << unit;
  }
}

TEST(NearCopies, AreNoneOfNothing) {
  EXPECT_FALSE(HasNearCopies({}));
  EXPECT_FALSE(HasNearCopies({Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3)}));
}

}  // namespace
}  // namespace ceres_ed
