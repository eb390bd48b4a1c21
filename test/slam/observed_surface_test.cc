#include "ceres_ed/slam/frame/observed_surface.h"

#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>

namespace ceres_ed {
namespace {

ObservedSurface Observe(const DepthImage& depth, double scale = 1.0) {
  return ObservedSurface(depth, SmallCamera(), scale, ObservedSurfaceOptions());
}

// All patches except the last one, whose window of 4 x 4 pixels at the corner is less than 0.4 of 7
// x 7.
constexpr int kAllValid = 80 * 60 - 1;

// Returns the pixel of patch (i, j), the middle of its cell of 2 x 2.
Eigen::Vector2d PixelOf(int i, int j) { return {2.0 * i + 1.0, 2.0 * j + 1.0}; }

bool SamePatches(const ObservedSurface& a, const ObservedSurface& b) {
  for (int j = 0; j < a.height(); ++j) {
    for (int i = 0; i < a.width(); ++i) {
      if (a.patch(i, j).point != b.patch(i, j).point) return false;
      if (a.patch(i, j).normal != b.patch(i, j).normal) return false;
      if (a.patch(i, j).deviation != b.patch(i, j).deviation) return false;
    }
  }
  return a.width() == b.width() && a.height() == b.height() && a.noise() == b.noise();
}

TEST(ObservedSurface, IsExactOnPlanesOfAnySlope) {
  // The least-squares fit transfers the pixels' rounding error e to the relative inverse depth by
  // less than 2 e (4 e in a corner of the picture), and to a slope by 2 e f. The bounds follow with
  // the ratio of the depths in view (1.6 to either side at 45 degrees).
  const double point_bound = 10.0 * kFloatRounding;
  const double normal_bound = 4.0 * kFloatRounding * 120.0;
  for (const double slope : {0.0, 15.0, 30.0, 45.0}) {
    for (const double azimuth : {0.0, 90.0, 215.0}) {
      const PlaneScene plane = TiltedPlane(0.3, slope, azimuth);
      const ObservedSurface surface = Observe(RenderDepth(SmallCamera(), plane));
      EXPECT_EQ(surface.num_valid(), kAllValid) << slope << " " << azimuth;
      double point_error = 0.0;
      double normal_error = 0.0;
      double pixel_error = 0.0;
      for (int j = 0; j < surface.height(); ++j) {
        for (int i = 0; i < surface.width(); ++i) {
          const SurfacePatch& patch = surface.patch(i, j);
          if (!patch.valid()) continue;
          point_error =
              std::max(point_error, std::abs(plane.Distance(patch.point)) / patch.point.norm());
          normal_error = std::max(normal_error, (patch.normal - plane.normal).norm());
          pixel_error =
              std::max(pixel_error, (SmallCamera().Project(patch.point) - PixelOf(i, j)).norm());
        }
      }
      EXPECT_LT(point_error, point_bound) << slope << " " << azimuth;
      EXPECT_LT(normal_error, normal_bound) << slope << " " << azimuth;
      EXPECT_LT(pixel_error, 1e-10);
      EXPECT_LT(surface.noise(), 0.3 * 4.0 * kFloatRounding);
    }
  }
}

TEST(ObservedSurface, ScalesLengthsAlone) {
  const DepthImage depth = RenderDepth(SmallCamera(), TiltedPlane(0.3, 30.0, 40.0));
  const ObservedSurface metres = Observe(depth);
  const ObservedSurface units = Observe(depth, 250.0);
  EXPECT_NEAR(units.noise(), 250.0 * metres.noise(), 1e-15 * 250.0);
  for (const int i : {0, 17, 79}) {
    EXPECT_LT((units.patch(i, 30).point - 250.0 * metres.patch(i, 30).point).norm(), 1e-12);
    EXPECT_LT((units.patch(i, 30).normal - metres.patch(i, 30).normal).norm(), 1e-15);
  }
}

TEST(ObservedSurface, ErrsOnASphereByItsCurvatureAlone) {
  // The radius is 0.1 at a distance of 0.3. Over a window of half-width r = 3 pixels, a surface
  // differs from its tangent plane by at most s^2 (1 + tan^2) / (2 R cos), where s is half the
  // diagonal of the window along the surface. The fit of a plane stays within that, and its normal
  // within s / R.
  const Eigen::Vector3d center(0.01, -0.02, 0.3);
  const double radius = 0.1;
  const auto sphere = [&](const Eigen::Vector3d& ray) {
    const double a = ray.squaredNorm();
    const double b = ray.dot(center);
    const double root = b * b - a * (center.squaredNorm() - radius * radius);
    return root > 0.0 ? (b - std::sqrt(root)) / a : 0.0;
  };
  const ObservedSurface surface = Observe(RenderDepth(SmallCamera(), sphere));
  int checked = 0;
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid()) continue;
      const Eigen::Vector3d out = patch.point - center;
      const double cosine = -out.normalized().dot(patch.point.normalized());
      // Nearer to the rim the window is cut off.
      if (cosine < 0.6) continue;
      const double s = 3.0 * std::sqrt(2.0) * patch.point.norm() / 120.0 / cosine;
      EXPECT_LT(std::abs(out.norm() - radius), s * s / (2.0 * radius) * cosine);
      EXPECT_LT((patch.normal - out.normalized()).norm(), s / radius);
      ++checked;
    }
  }
  EXPECT_GT(checked, 700);
}

TEST(ObservedSurface, DoesNotAverageOverADepthJump) {
  // A step of the depth: 0.30 on the left, 0.36 on the right, which is a slope of 87 degrees.
  const auto step = [](const Eigen::Vector3d& ray) { return ray.x() < 0.0 ? 0.30 : 0.36; };
  const ObservedSurface surface = Observe(RenderDepth(SmallCamera(), step));
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid()) continue;
      const double z = 2 * i + 1 < 79.5 ? 0.30 : 0.36;
      EXPECT_NEAR(patch.point.z(), z, 4.0 * kFloatRounding * z);
      EXPECT_NEAR(patch.normal.z(), -1.0, 1e-9);
    }
  }
  // Beside the step a window has 4 of 7 columns of its own surface, which is more than 0.4 of it,
  // except where the last row cuts it off as well.
  EXPECT_EQ(surface.num_valid(), kAllValid - 1);
}

TEST(ObservedSurface, LeavesOutHolesAndWhatIsNotADepth) {
  DepthImage depth = RenderDepth(SmallCamera(), TiltedPlane(0.3, 10.0, 0.0));
  // One dead pixel at a patch, one beside another patch, a hole of 20 x 20, a NaN, an infinity.
  depth(21, 21) = 0.0F;
  depth(40, 41) = 0.0F;
  for (int v = 60; v < 80; ++v) {
    for (int u = 100; u < 120; ++u) depth(u, v) = 0.0F;
  }
  depth(61, 21) = std::numeric_limits<float>::quiet_NaN();
  depth(81, 21) = std::numeric_limits<float>::infinity();
  const ObservedSurface surface = Observe(depth);
  EXPECT_FALSE(surface.patch(10, 10).valid());
  EXPECT_TRUE(surface.patch(20, 20).valid());
  EXPECT_FALSE(surface.patch(30, 10).valid());
  EXPECT_FALSE(surface.patch(40, 10).valid());
  int valid_in_hole = 0;
  for (int j = 30; j < 40; ++j) {
    for (int i = 50; i < 60; ++i) valid_in_hole += surface.patch(i, j).valid();
  }
  EXPECT_EQ(valid_in_hole, 0);
  EXPECT_EQ(surface.num_valid(), kAllValid - 3 - 100);
}

TEST(ObservedSurface, HasNothingToShowOfAnEmptyImage) {
  const ObservedSurface surface = Observe(DepthImage(160, 120, 0.0F));
  EXPECT_EQ(surface.num_valid(), 0);
  EXPECT_EQ(surface.noise(), 0.0);
  EXPECT_EQ(surface.Find({80.0, 60.0}), nullptr);
}

TEST(ObservedSurface, MeasuresTheNoiseOfAPixel) {
  // The windows of 49 pixels have 46 degrees of freedom; the median of their deviations is (1 - 2 /
  // (9 46))^1.5 = 0.9927 sigma. 19200 / 49 = 392 windows have no pixels in common, and each has a
  // spread of sigma / sqrt(92), so that the median is known to 0.0066 sigma; the bound is three
  // times that.
  const double sigma = 0.4e-3;
  Random random(7);
  DepthImage depth = RenderDepth(SmallCamera(), TiltedPlane(0.3, 15.0, 30.0));
  for (float& z : depth.pixels()) z += static_cast<float>(sigma * random.Gaussian());
  EXPECT_NEAR(Observe(depth).noise(), 0.9927 * sigma, 0.02 * sigma);
  EXPECT_NEAR(Observe(depth, 100.0).noise(), 99.27 * sigma, 2.0 * sigma);
}

TEST(ObservedSurface, HasTheSameBitsOnAnyNumberOfThreads) {
  Random random(3);
  DepthImage depth = RenderDepth(SmallCamera(), HillScene());
  for (float& z : depth.pixels()) z += static_cast<float>(0.02 * random.Gaussian());
  ObservedSurfaceOptions options;
  const ObservedSurface one(depth, SmallCamera(), 1.7, options);
  for (const int threads : {2, 5}) {
    options.num_threads = threads;
    EXPECT_TRUE(SamePatches(one, ObservedSurface(depth, SmallCamera(), 1.7, options)));
  }
  EXPECT_GT(one.num_valid(), 4000);
}

TEST(ObservedSurface, FindsTheCellOfAPixelAndNothingOutside) {
  const ObservedSurface surface = Observe(RenderDepth(SmallCamera(), TiltedPlane(0.3, 0.0, 0.0)));
  EXPECT_EQ(surface.Find({0.0, 0.0}), &surface.patch(0, 0));
  EXPECT_EQ(surface.Find({-0.5, -0.5}), &surface.patch(0, 0));
  EXPECT_EQ(surface.Find({1.49, 0.2}), &surface.patch(0, 0));
  EXPECT_EQ(surface.Find({1.5, 1.49}), &surface.patch(1, 0));
  EXPECT_EQ(surface.Find({40.7, 61.2}), &surface.patch(20, 30));
  EXPECT_EQ(surface.Find({159.49, 0.0}), &surface.patch(79, 0));
  EXPECT_EQ(surface.Find({0.0, 119.49}), &surface.patch(0, 59));
  EXPECT_EQ(surface.Find({159.0, 119.0}), nullptr);
  EXPECT_EQ(surface.Find({159.51, 60.0}), nullptr);
  EXPECT_EQ(surface.Find({80.0, 119.51}), nullptr);
  EXPECT_EQ(surface.Find({-0.51, 60.0}), nullptr);
  EXPECT_EQ(surface.Find({80.0, -0.51}), nullptr);
  EXPECT_EQ(surface.Find({1e9, 0.0}), nullptr);
  EXPECT_EQ(surface.Find({-1e9, -1e9}), nullptr);
  EXPECT_EQ(surface.Find({std::nan(""), 3.0}), nullptr);
}

TEST(ObservedSurface, CoversPicturesThatCellsDoNotDivide) {
  const PinholeCamera camera = {20.0, 20.0, 8.0, 6.0, 17, 13};
  ObservedSurfaceOptions options;
  options.cell = 3;
  const PlaneScene plane = TiltedPlane(2.0, 0.0, 0.0);
  const ObservedSurface surface(RenderDepth(camera, plane), camera, 1.0, options);
  EXPECT_EQ(surface.width(), 6);
  EXPECT_EQ(surface.height(), 5);
  const SurfacePatch* last = surface.Find({16.4, 12.4});
  EXPECT_EQ(last, surface.patch(5, 4).valid() ? &surface.patch(5, 4) : nullptr);
  // The cell is cut off, because its middle would be outside.
  EXPECT_LT((camera.Project(surface.patch(5, 2).point) - Eigen::Vector2d(16.0, 7.0)).norm(), 1e-12);
}

// The spread of the normals is measured, not computed by the formula that is tested.
TEST(ObservedSurface, RadiusForNoiseMakesSlopesAsCertainAsAskedFor) {
  constexpr double kDepth = 0.2;
  constexpr double kNoise = 0.0008;
  DepthImage depth(160, 120, 0.0F);
  Random random(7);
  for (float& z : depth.pixels()) z = static_cast<float>(kDepth + kNoise * random.Gaussian());
  const auto slope_deviation = [&depth](int radius) {
    ObservedSurfaceOptions options;
    options.radius = radius;
    const ObservedSurface surface(depth, SmallCamera(), 1.0, options);
    double squares = 0.0;
    for (int j = 10; j < 50; ++j) {
      for (int i = 10; i < 70; ++i) {
        const Eigen::Vector3d& n = surface.patch(i, j).normal;
        squares += n.head<2>().squaredNorm() / (n.z() * n.z()) / 2.0;
      }
    }
    return std::sqrt(squares / (40.0 * 60.0));
  };
  for (const double asked : {0.05, 0.02, 0.01}) {
    ObservedSurfaceOptions options;
    options.max_slope_noise = asked;
    const int radius = ObservedSurface(depth, SmallCamera(), 1.0, options).RadiusForNoise();
    // The sample of correlated windows has a spread of its own.
    EXPECT_LT(slope_deviation(radius), 1.15 * asked) << radius;
    if (radius > ObservedSurfaceOptions().radius) {
      EXPECT_GT(slope_deviation(radius - 1), 0.85 * asked) << radius;
    }
  }
}

TEST(ObservedSurface, KeepsItsRadiusWhereThereIsNoNoise) {
  const ObservedSurface surface = Observe(RenderDepth(SmallCamera(), TiltedPlane(0.3, 30.0, 90.0)));
  EXPECT_EQ(surface.RadiusForNoise(), ObservedSurfaceOptions().radius);
}

}  // namespace
}  // namespace ceres_ed
