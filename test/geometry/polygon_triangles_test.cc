#include "ceres_ed/geometry/polygon_triangles.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using Corners = std::vector<Eigen::Vector3d>;
using Triangle = std::array<int, 3>;

// The corners in a tilted plane, a little bent.
Corners Tilted(const Corners& flat) {
  const Eigen::AngleAxisd tilt(0.9, Eigen::Vector3d(1, 2, -1).normalized());
  Corners tilted;
  for (const Eigen::Vector3d& p : flat) {
    tilted.emplace_back(tilt * (p + Eigen::Vector3d(0, 0, 0.01 * std::sin(3.0 * p.x()))));
  }
  return tilted;
}

// Expects triangles that cover the flat polygon once: none is turned over, and their areas add up
// to that of the polygon.
void ExpectCovers(const Corners& flat, double area) {
  const std::vector<Triangle> triangles = PolygonTriangles(Tilted(flat));
  ASSERT_EQ(triangles.size(), flat.size() - 2);
  double sum = 0.0;
  for (const Triangle& t : triangles) {
    const double twice = (flat[t[1]] - flat[t[0]]).cross(flat[t[2]] - flat[t[0]]).z();
    EXPECT_GE(twice, 0.0);
    sum += 0.5 * twice;
  }
  EXPECT_NEAR(sum, area, 1e-12);
}

TEST(PolygonTriangles, OfAConvexPolygonAreTheFanOfItsFirstCorner) {
  const Corners pentagon = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_THAT(PolygonTriangles(Tilted(pentagon)),
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
}

TEST(PolygonTriangles, CoverConcavePolygonsOnceFromAnyFirstCorner) {
  const Corners l_shape = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const Corners u_shape = {
      {0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const Corners arrow = {{0, 0, 0}, {1, 0.5, 0}, {0, 1, 0}, {0.4, 0.5, 0}};
  for (const auto& [polygon, area] :
       {std::pair(l_shape, 3.0), std::pair(u_shape, 7.0), std::pair(arrow, 0.3)}) {
    for (std::size_t first = 0; first < polygon.size(); ++first) {
      Corners turned(polygon.begin() + static_cast<std::ptrdiff_t>(first), polygon.end());
      turned.insert(
          turned.end(), polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>(first));
      ExpectCovers(turned, area);
    }
  }
}

TEST(PolygonTriangles, AreWellShapedAlongStraightSides) {
  // A U of seven squares, with a corner at each.
  const Corners u_shape = {{0, 0, 0},
                           {1, 0, 0},
                           {2, 0, 0},
                           {3, 0, 0},
                           {3, 1, 0},
                           {3, 2, 0},
                           {3, 3, 0},
                           {2, 3, 0},
                           {2, 2, 0},
                           {2, 1, 0},
                           {1, 1, 0},
                           {1, 2, 0},
                           {1, 3, 0},
                           {0, 3, 0},
                           {0, 2, 0},
                           {0, 1, 0}};
  ExpectCovers(u_shape, 7.0);
  for (const Triangle& t : PolygonTriangles(Tilted(u_shape))) {
    const double twice = (u_shape[t[1]] - u_shape[t[0]]).cross(u_shape[t[2]] - u_shape[t[0]]).z();
    EXPECT_GT(twice, 0.5) << t[0] << ' ' << t[1] << ' ' << t[2];
  }
}

TEST(PolygonTriangles, OfWhatIsNoPolygonAreTwoFewerThanItsCorners) {
  EXPECT_TRUE(PolygonTriangles({{0, 0, 0}, {1, 0, 0}}).empty());
  const Corners point(5, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(PolygonTriangles(point).size(), 3u);
  const Corners bow = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0.5, 0}};
  EXPECT_EQ(PolygonTriangles(bow).size(), 3u);
  Corners star;
  for (int i = 0; i < 1000; ++i) {
    const double radius = i % 2 == 0 ? 1.0 : 0.5;
    star.emplace_back(radius * std::cos(0.002 * M_PI * i), radius * std::sin(0.002 * M_PI * i), 0);
  }
  EXPECT_EQ(PolygonTriangles(star).size(), 998u);
}

}  // namespace
}  // namespace ceres_ed
