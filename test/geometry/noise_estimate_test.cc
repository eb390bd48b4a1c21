#include <ceres_ed/geometry/noise_estimate.h>
#include <ceres_ed/simulation/shapes.h>
#include <ceres_ed/simulation/views.h>
#include <ceres_ed/util/random.h>

#include <cmath>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

double NoiseOf(const PointCloud& cloud) {
  return EstimateNoise(cloud.points, BuildTopology(cloud));
}

double NoiseOfBare(PointCloud cloud) {
  cloud.triangles.clear();
  return NoiseOf(cloud);
}

// Returns a shape whose vertices are about 0.002 apart.
PointCloud MakeKidney() { return MakeSyntheticShape(SyntheticShape::kKidney, 5000, 0.1); }

TEST(EstimateNoise, FindsTheDeviationThatWasAdded) {
  // The median over 500 places varies by about 2 % (and the places share points).
  for (const double sigma : {1e-4, 3e-4, 1e-3}) {
    PointCloud cloud = MakeKidney();
    AddSyntheticNoise(sigma, 5, &cloud);
    EXPECT_NEAR(NoiseOf(cloud), sigma, 0.15 * sigma);
  }
}

TEST(EstimateNoise, FindsTheSameOnBarePoints) {
  PointCloud cloud = MakeKidney();
  AddSyntheticNoise(2e-4, 6, &cloud);
  EXPECT_NEAR(NoiseOfBare(cloud), 2e-4, 0.15 * 2e-4);
}

TEST(EstimateNoise, IsSmallOnCleanShapes) {
  for (const SyntheticShape shape : {SyntheticShape::kDolphin,
                                     SyntheticShape::kHeart,
                                     SyntheticShape::kKidney,
                                     SyntheticShape::kStomach}) {
    const double size = DefaultSyntheticSize(shape);
    const PointCloud cloud = MakeSyntheticShape(shape, 5000, size);
    EXPECT_LT(NoiseOf(cloud), 1e-4 * size) << SyntheticShapeName(shape);
    EXPECT_LT(NoiseOfBare(cloud), 1e-4 * size) << SyntheticShapeName(shape);
  }
}

TEST(EstimateNoise, CountsNoiseAlongOneAxisWithItsPartAcrossTheSurface) {
  const PointCloud grid = MakeGridMesh(60, 60, 1.0);
  Random random(3);
  PointCloud across = grid;
  PointCloud tilted = grid;
  for (std::size_t p = 0; p < grid.size(); ++p) {
    const double noise = 0.2 * random.Gaussian();
    across.points[p].z() += noise;
    tilted.points[p] += noise * Eigen::Vector3d(0.8, 0.0, 0.6);
  }
  EXPECT_NEAR(NoiseOf(across), 0.2, 0.02);
  EXPECT_NEAR(NoiseOf(tilted), 0.6 * 0.2, 0.02);
}

TEST(EstimateNoise, FindsNoiseThatIsLargerThanAnEdge) {
  PointCloud cloud = MakeGridMesh(80, 80, 1.0);
  Random random(4);
  for (Eigen::Vector3d& point : cloud.points) point.z() += 2.0 * random.Gaussian();
  EXPECT_NEAR(NoiseOf(cloud), 2.0, 0.2);
}

TEST(EstimateNoise, ScalesWithTheUnit) {
  PointCloud cloud = MakeKidney();
  AddSyntheticNoise(3e-4, 7, &cloud);
  const double noise = NoiseOf(cloud);
  for (Eigen::Vector3d& point : cloud.points) point = 1000.0 * point + Eigen::Vector3d(5, 6, 7);
  EXPECT_NEAR(NoiseOf(cloud), 1000.0 * noise, 1e-6 * 1000.0 * noise);
}

TEST(EstimateNoise, IsNothingWhereThereAreTooFewPoints) {
  EXPECT_EQ(NoiseOf(MakeGridMesh(4, 4)), 0.0);
  EXPECT_EQ(NoiseOfBare(MakeGridMesh(4, 4)), 0.0);
}

}  // namespace
}  // namespace ceres_ed
