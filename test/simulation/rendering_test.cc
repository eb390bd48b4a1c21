#include <ceres_ed/simulation/rendering.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

PinholeCamera Camera() { return {70.0, 65.0, 31.0, 24.5, 64, 48}; }

// Returns the depth of the nearest triangle on the ray of a pixel, computed from the barycentric
// weights, or 0 if there is none.
double CastRay(const std::vector<Eigen::Vector3d>& points,
               const Triangles& triangles,
               const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles) {
    Eigen::Matrix3d system;
    system << points[b] - points[a], points[c] - points[a], -ray;
    const Eigen::Vector3d x = system.fullPivLu().solve(-points[a]);
    if (x.x() < 0 || x.y() < 0 || x.x() + x.y() > 1 || x.z() <= 0) continue;
    nearest = std::min(nearest, x.z());
  }
  return std::isinf(nearest) ? 0.0 : nearest;
}

TEST(RasterizeMesh, GivesTheDepthOfATiltedPlaneInClosedForm) {
  // The plane n . p = d, as two triangles that extend beyond the picture.
  const Eigen::Vector3d n = Eigen::Vector3d(0.4, -0.3, 1.0).normalized();
  const double d = 0.2;
  std::vector<Eigen::Vector3d> points;
  for (const auto& [x, y] : {std::pair(-0.3, -0.3), {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}) {
    points.emplace_back(x, y, (d - n.x() * x - n.y() * y) / n.z());
  }
  const SyntheticRaster raster = RasterizeMesh(points, {{0, 1, 2}, {0, 2, 3}}, Camera());
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const double expected = d / n.dot(Camera().BackProject(u, v, 1.0));
      ASSERT_NEAR(raster.depth(u, v), expected, 1e-7) << u << " " << v;
    }
  }
}

TEST(RasterizeMesh, SeesWhatARayOfItsOwnHits) {
  PointCloud mesh = MakeSyntheticShape(SyntheticShape::kStomach, 800, 0.1);
  for (Eigen::Vector3d& point : mesh.points) point.z() += 0.13;
  const SyntheticRaster raster = RasterizeMesh(mesh.points, mesh.triangles, Camera());
  int seen = 0;
  for (int v = 1; v < 48; v += 3) {
    for (int u = 2; u < 64; u += 3) {
      const Eigen::Vector3d ray = Camera().BackProject(u, v, 1.0);
      const double expected = CastRay(mesh.points, mesh.triangles, ray);
      ASSERT_NEAR(raster.depth(u, v), expected, 1e-7) << u << " " << v;
      ASSERT_EQ(raster.fragments(u, v).triangle >= 0, expected > 0.0);
      if (expected > 0.0) ++seen;
    }
  }
  EXPECT_GT(seen, 50);
  EXPECT_LT(seen, 250);
}

TEST(RasterizeMesh, InterpolatesInSpaceNotInThePicture) {
  const std::vector<Eigen::Vector3d> points = {
      {-0.3, -0.2, 0.2}, {0.5, -0.3, 0.9}, {0.05, 0.4, 0.4}};
  const Triangles triangles = {{0, 1, 2}};
  const SyntheticRaster raster = RasterizeMesh(points, triangles, Camera());
  int seen = 0;
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      if (raster.fragments(u, v).triangle < 0) continue;
      ++seen;
      const Eigen::Vector3d expected = Camera().BackProject(u, v, double(raster.depth(u, v)));
      ASSERT_LT((raster.Interpolate(triangles, points, u, v) - expected).norm(), 1e-6);
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(RasterizeMesh, KeepsTheNearerOfTwoInAnyOrder) {
  const std::vector<Eigen::Vector3d> points = {
      {-1, -1, 0.5}, {1, -1, 0.5}, {0, 1, 0.5}, {-1, -1, 0.3}, {1, -1, 0.3}, {0, 1, 0.3}};
  for (const Triangles& triangles : {Triangles{{0, 1, 2}, {3, 4, 5}}, {{3, 4, 5}, {0, 1, 2}}}) {
    EXPECT_FLOAT_EQ(RasterizeMesh(points, triangles, Camera()).depth(31, 24), 0.3F);
  }
}

TEST(RasterizeMesh, LeavesOutWhatReachesBehindTheCamera) {
  const SyntheticRaster raster =
      RasterizeMesh({{-1, -1, 0.5}, {1, -1, 0.5}, {0, 1, -0.5}}, {{0, 1, 2}}, Camera());
  const auto& depth = raster.depth.pixels();
  EXPECT_TRUE(std::all_of(depth.begin(), depth.end(), [](float z) { return z == 0.0F; }));
}

TEST(RasterizeMesh, LeavesNoCracksInAFineMesh) {
  // There are far more triangles than pixels, with vertices and edges exactly on pixel centres.
  PointCloud plane = MakeSyntheticShape(SyntheticShape::kPlane, 10000, 0.4);
  for (Eigen::Vector3d& point : plane.points) point.z() += 0.2;
  const PinholeCamera camera = {50.0, 50.0, 32.0, 24.0, 64, 48};
  const SyntheticRaster raster = RasterizeMesh(plane.points, plane.triangles, camera);
  for (const float z : raster.depth.pixels()) ASSERT_FLOAT_EQ(z, 0.2F);
}

TEST(IncidenceCosines, AreThoseOfASphere) {
  // A body projected to a sphere, with the normals of the sphere.
  PointCloud mesh = MakeSyntheticShape(SyntheticShape::kHeart, 1000, 0.1);
  const Eigen::Vector3d center(0.0, 0.0, 0.3);
  std::vector<Eigen::Vector3d> normals;
  for (Eigen::Vector3d& point : mesh.points) {
    normals.push_back(point.normalized());
    point = center + 0.1 * point.normalized();
  }
  const SyntheticRaster raster = RasterizeMesh(mesh.points, mesh.triangles, Camera());
  const Image<float> cosines = IncidenceCosines(raster, mesh.triangles, normals, Camera());
  for (int v = 12; v < 36; ++v) {
    for (int u = 20; u < 44; ++u) {
      const Eigen::Vector3d ray = Camera().BackProject(u, v, 1.0).normalized();
      // The sine of the angle at the surface is the distance of the ray from the centre, divided by
      // the radius.
      const double sine = (center - center.dot(ray) * ray).norm() / 0.1;
      if (sine > 0.8) continue;
      ASSERT_NEAR(cosines(u, v), std::sqrt(1.0 - sine * sine), 0.01) << u << " " << v;
    }
  }
  EXPECT_EQ(cosines(0, 0), 0.0F);
}

TEST(SyntheticTexture, ShowsContrastAtEveryDistanceUpToItsLargestMottles) {
  const SyntheticTexture texture(1);
  for (const double pixel : {5e-5, 1.5e-4, 5e-4, 1.5e-3}) {
    // The differences of points three pixels apart, which is what a corner detector sees.
    double sum = 0.0;
    constexpr int kSamples = 2000;
    for (int k = 0; k < kSamples; ++k) {
      const Eigen::Vector3d p(0.0013 * k, 0.0007 * (k % 37), 0.002 * (k % 11));
      const Eigen::Vector3d q = p + Eigen::Vector3d(3.0 * pixel, 0.0, 0.0);
      sum += (texture.Color(p, pixel) - texture.Color(q, pixel)).cwiseAbs().maxCoeff();
    }
    // This is well above the rounding of 8 bits.
    EXPECT_GT(sum / kSamples, 5.0 / 255.0) << pixel;
  }
}

TEST(SyntheticTexture, IsOneColourWhereAPixelCoversEverything) {
  const SyntheticTexture texture(1);
  EXPECT_EQ(texture.Color({0.01, 0.02, 0.03}, 0.1), texture.Color({0.4, -0.1, 0.2}, 0.1));
}

TEST(SyntheticTexture, DependsOnItsSeed) {
  const Eigen::Vector3d p(0.011, 0.002, -0.013);
  EXPECT_EQ(SyntheticTexture(1).Color(p, 1e-4), SyntheticTexture(1).Color(p, 1e-4));
  EXPECT_NE(SyntheticTexture(1).Color(p, 1e-4), SyntheticTexture(2).Color(p, 1e-4));
  EXPECT_NE(SyntheticTexture(1).Color(p, 1e-4),
            SyntheticTexture(1 + (std::uint64_t{1} << 32)).Color(p, 1e-4));
}

// Returns the depth errors of a flat wall that is seen under the same cosine everywhere.
class DepthNoise : public ::testing::Test {
 protected:
  DepthImage Noisy(double sigma, std::uint64_t seed, float cosine) const {
    DepthImage depth(kSize, kSize, 1.0F);
    AddDepthNoise({sigma, 0.0}, seed, Image<float>(kSize, kSize, cosine), &depth);
    return depth;
  }

  static constexpr int kSize = 400;
};

TEST_F(DepthNoise, HasTheStatedSpreadAndNoBias) {
  // With 160,000 pixels and some correlation, the spread is known to about 0.4 %.
  for (const float cosine : {1.0F, 0.5F}) {
    const DepthImage depth = Noisy(1e-3, 5, cosine);
    double sum = 0.0;
    double squares = 0.0;
    double products = 0.0;
    for (int v = 0; v < kSize; ++v) {
      for (int u = 0; u < kSize; ++u) {
        const double error = double(depth(u, v)) - 1.0;
        sum += error;
        squares += error * error;
        if (u > 0) products += error * (double(depth(u - 1, v)) - 1.0);
      }
    }
    const double sigma = 1e-3 / double(cosine);
    EXPECT_NEAR(sum / (kSize * kSize), 0.0, 0.05 * sigma);
    EXPECT_NEAR(std::sqrt(squares / (kSize * kSize)), sigma, 0.015 * sigma);
    EXPECT_NEAR(products / squares, 0.4, 0.02);
  }
}

TEST_F(DepthNoise, DropsPixelsOutTowardGrazingAngles) {
  const auto share = [this](float cosine) {
    const DepthImage depth = Noisy(1e-4, 5, cosine);
    const auto& z = depth.pixels();
    return double(std::count(z.begin(), z.end(), 0.0F)) / double(z.size());
  };
  EXPECT_EQ(share(0.36F), 0.0);
  EXPECT_NEAR(share(0.225F), 0.5, 0.01);
  EXPECT_EQ(share(0.09F), 1.0);
}

TEST_F(DepthNoise, IsTheSameForTheSameSeedAlone) {
  EXPECT_EQ(Noisy(1e-3, 7, 0.3F).pixels(), Noisy(1e-3, 7, 0.3F).pixels());
  EXPECT_NE(Noisy(1e-3, 7, 1.0F).pixels(), Noisy(1e-3, 8, 1.0F).pixels());
}

TEST_F(DepthNoise, OfZeroChangesNothing) {
  EXPECT_EQ(Noisy(0.0, 7, 0.05F).pixels(), DepthImage(kSize, kSize, 1.0F).pixels());
}

}  // namespace
}  // namespace ceres_ed
