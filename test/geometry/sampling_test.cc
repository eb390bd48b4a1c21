#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/geometry/surface_distance.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// The quality of samples: no two are nearer than `packing`, and every point has one within `cover`.
struct Radii {
  double packing = std::numeric_limits<double>::infinity();
  double cover = 0.0;
};

template <typename Distance>
Radii Measure(int num_points, const std::vector<int>& samples, const Distance& distance) {
  Radii radii;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t k = i + 1; k < samples.size(); ++k) {
      radii.packing = std::min(radii.packing, distance(i, samples[k]));
    }
  }
  for (int p = 0; p < num_points; ++p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < samples.size(); ++i) nearest = std::min(nearest, distance(i, p));
    radii.cover = std::max(radii.cover, nearest);
  }
  return radii;
}

Radii MeasureInSpace(const std::vector<Eigen::Vector3d>& points, const std::vector<int>& samples) {
  return Measure(static_cast<int>(points.size()), samples, [&](std::size_t i, int p) {
    return (points[samples[i]] - points[p]).norm();
  });
}

std::vector<double> DistancesFrom(int point, const SurfaceTopology& topology) {
  return NearestSeedsAlongSurface(topology, {point}, 1).distances;
}

Radii MeasureAlongSurface(const SurfaceTopology& topology, const std::vector<int>& samples) {
  std::vector<std::vector<double>> from;
  for (const int sample : samples) from.push_back(DistancesFrom(sample, topology));
  return Measure(topology.num_points(), samples, [&](std::size_t i, int p) { return from[i][p]; });
}

TEST(UniformDownsample, CoversAndPacks) {
  const std::vector<Eigen::Vector3d> points = RandomPoints(2000, 11);
  const Radii radii = MeasureInSpace(points, UniformDownsample(points, 0.3));
  EXPECT_LE(radii.cover, 0.3);
  EXPECT_GE(radii.packing, 0.3 * (1.0 - 1e-8));
}

TEST(UniformDownsample, KeepsPointsThatAreASpacingApart) {
  const std::vector<Eigen::Vector3d> points = MakeGridMesh(20, 1, 0.1).points;
  // Multiples of 0.1 and of 100 are rounded differently; such rounding errors must not decide.
  EXPECT_EQ(UniformDownsample(points, 0.1).size(), 20u);
  EXPECT_EQ(UniformDownsample(MakeGridMesh(20, 1, 100.0).points, 100.0).size(), 20u);
  EXPECT_EQ(UniformDownsample(points, 0.11).size(), 10u);
}

TEST(UniformDownsample, DoesNotDependOnTheOrderOfThePoints) {
  std::vector<Eigen::Vector3d> points = RandomPoints(500, 12);
  std::vector<Eigen::Vector3d> reversed(points.rbegin(), points.rend());
  std::vector<int> samples = UniformDownsample(points, 0.4);
  const std::vector<int> mirrored = UniformDownsample(reversed, 0.4);
  ASSERT_EQ(samples.size(), mirrored.size());
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i], 499 - mirrored[i]);
}

TEST(UniformDownsample, SurvivesASpacingFarBelowTheExtent) {
  const std::vector<Eigen::Vector3d> points = RandomPoints(100, 13, 1e9);
  EXPECT_EQ(UniformDownsample(points, 1e-9).size(), 100u);
}

TEST(UniformDownsampleAlongSurface, CoversAndPacks) {
  PointCloud mesh = MakeSphereMesh(3);
  Jitter(0.01, 14, &mesh);
  const SurfaceTopology topology = BuildTopology(mesh);
  const Radii radii = MeasureAlongSurface(topology, UniformDownsampleAlongSurface(topology, 0.4));
  EXPECT_LE(radii.cover, 0.4);
  EXPECT_GE(radii.packing, 0.4 * (1.0 - 1e-8));
}

TEST(UniformDownsampleAlongSurface, SheetsThatTouchGetSamplesOfTheirOwn) {
  const PointCloud sheet = MakeGridMesh(21, 21, 0.1);
  const PointCloud mesh = Append(sheet, sheet, {0, 0, 1e-3});
  const std::vector<int> samples = UniformDownsampleAlongSurface(BuildTopology(mesh), 0.5);
  const auto on_first =
      std::count_if(samples.begin(), samples.end(), [](int p) { return p < 441; });
  EXPECT_EQ(2 * on_first, static_cast<int>(samples.size()));
  EXPECT_GT(on_first, 10);
}

TEST(UniformDownsampleAlongSurface, SmallComponentsGetNoneAndAllOthersOne) {
  PointCloud mesh = Append(MakeGridMesh(3, 3), MakeGridMesh(2, 2), {10, 0, 0});
  mesh.points.emplace_back(50, 0, 0);
  const SurfaceTopology topology = BuildTopology(mesh);
  EXPECT_EQ(UniformDownsampleAlongSurface(topology, 100.0, 1).size(), 3u);
  EXPECT_EQ(UniformDownsampleAlongSurface(topology, 100.0, 4).size(), 2u);
  EXPECT_EQ(UniformDownsampleAlongSurface(topology, 100.0, 5).size(), 1u);
}

TEST(FarthestPointSample, EachSampleIsTheFarthestFromThoseBefore) {
  const std::vector<Eigen::Vector3d> points = RandomPoints(300, 15);
  FarthestPointOptions options;
  options.max_count = 25;
  const std::vector<int> samples = FarthestPointSample(points, options);
  ASSERT_EQ(samples.size(), 25u);
  for (std::size_t n = 1; n < samples.size(); ++n) {
    const std::vector<int> before(samples.begin(), samples.begin() + n);
    double nearest = std::numeric_limits<double>::infinity();
    for (const int p : before) nearest = std::min(nearest, (points[p] - points[samples[n]]).norm());
    EXPECT_DOUBLE_EQ(nearest, MeasureInSpace(points, before).cover);
  }
}

TEST(FarthestPointSample, StopsAtTheSpacingAndAtTheLastPosition) {
  std::vector<Eigen::Vector3d> points = RandomPoints(300, 16);
  FarthestPointOptions options;
  options.min_spacing = 0.4;
  const Radii radii = MeasureInSpace(points, FarthestPointSample(points, options));
  EXPECT_LE(radii.cover, 0.4);
  EXPECT_GE(radii.packing, 0.4 * (1.0 - 1e-8));
  points.push_back(points.front());
  EXPECT_EQ(FarthestPointSample(points, FarthestPointOptions()).size(), 300u);
}

TEST(FarthestPointSampleAlongSurface, EachSampleIsTheFarthestFromThoseBefore) {
  PointCloud mesh = MakeSphereMesh(3);
  Jitter(0.01, 17, &mesh);
  const SurfaceTopology topology = BuildTopology(mesh);
  FarthestPointOptions options;
  options.max_count = 30;
  const std::vector<int> samples = FarthestPointSampleAlongSurface(topology, options);
  ASSERT_EQ(samples.size(), 30u);
  for (std::size_t n = 1; n < samples.size(); ++n) {
    const std::vector<int> before(samples.begin(), samples.begin() + n);
    double nearest = std::numeric_limits<double>::infinity();
    for (const int p : before) {
      nearest = std::min(nearest, DistancesFrom(p, topology)[samples[n]]);
    }
    EXPECT_NEAR(nearest, MeasureAlongSurface(topology, before).cover, 1e-13);
  }
}

TEST(FarthestPointSampleAlongSurface, ComponentsTakeTurnsFirst) {
  PointCloud mesh = Append(MakeGridMesh(9, 9), MakeGridMesh(3, 3), {20, 0, 0});
  mesh = Append(mesh, MakeGridMesh(2, 2), {40, 0, 0});
  const SurfaceTopology topology = BuildTopology(mesh);
  FarthestPointOptions options;
  options.max_count = 4;
  std::set<int> components;
  for (const int p : FarthestPointSampleAlongSurface(topology, options, 9)) {
    components.insert(topology.component[p]);
  }
  EXPECT_EQ(components, (std::set<int>{0, 1}));
  options.max_count = 3;
  EXPECT_EQ(FarthestPointSampleAlongSurface(topology, options, 1).size(), 3u);
  components.clear();
  for (const int p : FarthestPointSampleAlongSurface(topology, options, 1)) {
    components.insert(topology.component[p]);
  }
  EXPECT_EQ(components, (std::set<int>{0, 1, 2}));
}

TEST(FarthestPointSampleAlongSurface, StopsAtTheSpacing) {
  const SurfaceTopology topology = BuildTopology(MakeSphereMesh(3));
  FarthestPointOptions options;
  options.min_spacing = 0.5;
  const Radii radii =
      MeasureAlongSurface(topology, FarthestPointSampleAlongSurface(topology, options));
  EXPECT_LE(radii.cover, 0.5);
  EXPECT_GE(radii.packing, 0.5 * (1.0 - 1e-8));
}

}  // namespace
}  // namespace ceres_ed
