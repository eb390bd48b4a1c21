#include <ceres_ed/simulation/rendering.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

PinholeCamera Camera() { return {70.0, 65.0, 31.0, 24.5, 64, 48}; }

TEST(IncidenceCosines, AreThoseOfASphere) {
  // A body projected to a sphere, with the normals of the sphere.
  PointCloud mesh = MakeSyntheticShape(SyntheticShape::kHeart, 1000, 0.1);
  const Eigen::Vector3d center(0.0, 0.0, 0.3);
  std::vector<Eigen::Vector3d> normals;
  for (Eigen::Vector3d& point : mesh.points) {
    normals.push_back(point.normalized());
    point = center + 0.1 * point.normalized();
  }
  const MeshRaster raster = RasterizeMesh(mesh.points, mesh.triangles, Camera());
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
