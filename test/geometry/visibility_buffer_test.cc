#include "ceres_ed/geometry/visibility_buffer.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

constexpr double kTolerance = 0.03;

// Returns a camera that sees x and y from -1 to 1 at z = 1.
PinholeCamera MakeCamera() { return {50.0, 50.0, 49.5, 49.5, 100, 100}; }

// Returns the square |x|, |y| <= half at depth z.
PointCloud Square(double half, double z) {
  PointCloud square;
  square.points = {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  return square;
}

TEST(PixelOf, TakesIntegersForPixelCentres) {
  const PinholeCamera camera = {1.0, 1.0, 0.0, 0.0, 4, 3};
  const auto pixel_at = [&camera](double u, double v) { return PixelOf(camera, {u, v, 1.0}); };
  EXPECT_EQ(pixel_at(-0.49, 2.49), (std::array<int, 2>{0, 2}));
  EXPECT_EQ(pixel_at(3.49, -0.5), (std::array<int, 2>{3, 0}));
  EXPECT_FALSE(pixel_at(-0.51, 0.0));
  EXPECT_FALSE(pixel_at(3.5, 0.0));
  EXPECT_FALSE(pixel_at(0.0, 2.5));
}

TEST(PixelOf, FindsNoneBehindTheCameraOrForNumbersThatAreNotFinite) {
  const PinholeCamera camera = MakeCamera();
  EXPECT_FALSE(PixelOf(camera, {0.0, 0.0, -1.0}));
  EXPECT_FALSE(PixelOf(camera, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(PixelOf(camera, {1e300, 0.0, 1e-10}));
  EXPECT_FALSE(PixelOf(camera, {std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0}));
}

TEST(VisibilityBuffer, HidesWhatIsBehindAMeshByMoreThanTheTolerance) {
  VisibilityBuffer buffer(MakeCamera());
  buffer.AddTriangles(Square(0.5, 1.0));
  for (const double x : {-0.48, 0.0, 0.31, 0.48}) {
    EXPECT_TRUE(buffer.Sees({x, -x, 1.0}, kTolerance)) << x;
    EXPECT_TRUE(buffer.Sees({1.03 * x, x, 1.03}, kTolerance)) << x;
    EXPECT_FALSE(buffer.Sees({1.04 * x, x, 1.04}, kTolerance)) << x;
  }
  // Beside the square nothing is hidden. Outside the image nothing is seen.
  EXPECT_TRUE(buffer.Sees({1.2, 0.0, 2.0}, kTolerance));
  EXPECT_FALSE(buffer.Sees({2.1, 0.0, 2.0}, kTolerance));
}

TEST(VisibilityBuffer, InterpolatesDepthOnASlope) {
  // On the plane z = 2 + x only 1 / z is interpolated exactly.
  PointCloud slope;
  slope.points = {{-1, -3, 1}, {2, -3, 4}, {2, 3, 4}, {-1, 3, 1}};
  slope.triangles = {{0, 2, 1}, {0, 3, 2}};
  VisibilityBuffer buffer(MakeCamera());
  buffer.AddTriangles(slope);
  for (int u = 0; u < 100; u += 7) {
    const Eigen::Vector3d ray = MakeCamera().BackProject(u, 31, 1.0);
    const double z = 2.0 / (1.0 - ray.x());
    if (z < 1.0 || z > 4.0) continue;
    EXPECT_TRUE(buffer.Sees(z * (1.0 - 1e-5) * ray, 1e-6)) << u;
    EXPECT_FALSE(buffer.Sees(z * (1.0 + 1e-5) * ray, 1e-6)) << u;
  }
}

TEST(VisibilityBuffer, KeepsThePartInFrontOfTheCamera) {
  // A floor below the camera that runs from far behind it to far ahead.
  PointCloud floor;
  floor.points = {{-100, 1, -100}, {100, 1, -100}, {0, 1, 100}};
  floor.triangles = {{0, 1, 2}};
  VisibilityBuffer buffer(MakeCamera());
  buffer.AddTriangles(floor);
  EXPECT_TRUE(buffer.Sees({0.0, 0.95, 2.0}, kTolerance));
  EXPECT_FALSE(buffer.Sees({0.0, 1.2, 2.0}, kTolerance));
  EXPECT_TRUE(buffer.Sees({0.0, -1.2, 2.0}, kTolerance));
}

TEST(VisibilityBuffer, ClosesTheGapsBetweenPoints) {
  // A wall of points that are 3 pixels apart, and one of points 2 pixels apart far behind it.
  std::vector<Eigen::Vector3d> wall, behind;
  for (int i = -8; i <= 8; ++i) {
    for (int j = -8; j <= 8; ++j) {
      wall.push_back({0.06 * i, 0.06 * j, 1.0});
      behind.push_back({0.05 * i, 0.05 * j, 1.5});
    }
  }
  std::vector<Eigen::Vector3d> both = behind;
  both.insert(both.end(), wall.begin(), wall.end());
  VisibilityBuffer buffer(MakeCamera());
  buffer.AddPoints(both);
  for (const Eigen::Vector3d& point : wall) EXPECT_TRUE(buffer.Sees(point, kTolerance));
  for (const Eigen::Vector3d& point : behind) EXPECT_FALSE(buffer.Sees(point, kTolerance));
}

}  // namespace
}  // namespace ceres_ed
