#include <ceres_ed/geometry/spatial_order.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

std::vector<int> Shuffle(std::size_t size, unsigned seed) {
  std::vector<int> order(size);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  return order;
}

double MeanStep(const std::vector<Eigen::Vector3d>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum / static_cast<double>(points.size() - 1);
}

PointCloud Heart() {
  PointCloud heart = MakeSyntheticShape(SyntheticShape::kHeart, 4000, 1.0);
  for (const Eigen::Vector3d& p : heart.points) {
    heart.normals.push_back(p.normalized());
    heart.intensities.push_back(std::abs(p.x()));
  }
  return heart;
}

TEST(SpatialOrder, BringsNeighboursTogetherFromAnyOrder) {
  const PointCloud heart = Heart();
  const std::vector<Eigen::Vector3d> sorted = Reordered(heart, SpatialOrder(heart.points)).points;
  const PointCloud shuffled = Reordered(heart, Shuffle(heart.size(), 7));
  EXPECT_GT(MeanStep(shuffled.points), 0.3);
  // The surface has 4000 points on about 1.5 square units: they lie 0.02 apart.
  EXPECT_LT(MeanStep(sorted), 0.05);
  EXPECT_EQ(Reordered(shuffled, SpatialOrder(shuffled.points)).points, sorted);
}

TEST(SpatialOrder, HasEachIndexOnceWhateverThePointsAre) {
  const double far = 1e100;
  for (const std::vector<Eigen::Vector3d>& points : std::vector<std::vector<Eigen::Vector3d>>{
           {},
           {{1, 2, 3}},
           {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}},
           {{0, 0, 0}, {far, 0, 0}, {-far, far, far}, {1, 0, 0}}}) {
    std::vector<int> order = SpatialOrder(points);
    std::sort(order.begin(), order.end());
    std::vector<int> expected(points.size());
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(order, expected);
  }
}

TEST(Reordered, IsTheSameSurfaceWithItsNormalsAndIntensities) {
  const PointCloud heart = Heart();
  const std::vector<int> order = Shuffle(heart.size(), 3);
  const PointCloud other = Reordered(heart, order);
  const std::vector<int> place = InverseOrder(order);
  for (std::size_t i = 0; i < heart.size(); ++i) {
    const auto at = static_cast<std::size_t>(place[i]);
    EXPECT_EQ(other.points[at], heart.points[i]);
    EXPECT_EQ(other.normals[at], heart.normals[i]);
    EXPECT_EQ(other.intensities[at], heart.intensities[i]);
  }
  // Triangles keep their direction: each one is there with its lowest corner first.
  std::set<std::array<int, 3>> triangles(other.triangles.begin(), other.triangles.end());
  EXPECT_EQ(triangles.size(), heart.triangles.size());
  for (std::array<int, 3> triangle : heart.triangles) {
    for (int& corner : triangle) corner = place[static_cast<std::size_t>(corner)];
    std::rotate(
        triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    EXPECT_EQ(triangles.count(triangle), 1U);
  }
  EXPECT_TRUE(std::is_sorted(other.triangles.begin(), other.triangles.end()));
}

}  // namespace
}  // namespace ceres_ed
