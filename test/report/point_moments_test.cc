#include <ceres_ed/report/view/scene.h>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Two points in three moments; the second one is there in the last two.
ViewSurface MovingPoints() {
  ViewSurface surface;
  surface.points = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  PointMoments moments;
  moments.count = 3;
  moments.first = {0, 1};
  moments.last = {2, 2};
  moments.places = {{0.0, 0.0, 0.0},
                    {1.0, 0.0, 0.0},
                    {0.0, 1.0, 0.0},
                    {1.0, 1.0, 0.0},
                    {0.0, 2.0, 0.0},
                    {1.0, 2.0, 0.0}};
  surface.moments = moments;
  return surface;
}

TEST(PointMoments, HaveTheirPlacesAlongTheWay) {
  const ViewSurface surface = MovingPoints();
  EXPECT_EQ(PointsAt(surface, 0.0)[1], Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(PointsAt(surface, 0.5)[1], Eigen::Vector3d(1.0, 1.0, 0.0));
  EXPECT_EQ(PointsAt(surface, 1.0)[0], Eigen::Vector3d(0.0, 2.0, 0.0));
  for (int m = 0; m < 3; ++m) EXPECT_EQ(surface.moments->MomentAt(surface.moments->AtOf(m)), m);
}

TEST(PointMoments, ShowAPointFromItsFirstMomentOn) {
  const ViewSurface surface = MovingPoints();
  EXPECT_FALSE(surface.IsThere(1, 0.0));
  EXPECT_TRUE(surface.IsThere(1, 0.5));
}

TEST(PointMoments, HaveValuesOfTheirOwnOrOneForAll) {
  const ViewSurface surface = MovingPoints();
  ScalarField one;
  one.values = {5.0, 6.0};
  EXPECT_EQ(one.values[surface.IndexOf(one, 1, 1.0)], 6.0);
  ScalarField of_moments;
  of_moments.values = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
  EXPECT_EQ(of_moments.values[surface.IndexOf(of_moments, 1, 0.5)], 3.0);
}

}  // namespace
}  // namespace ceres_ed
