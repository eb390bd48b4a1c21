#include "ceres_ed/preflight/repair.h"

#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/simulation/shapes.h>

#include <algorithm>
#include <cstddef>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// A body whose triangles share no vertices, each moved by less than a rounding error of floats.
PointCloud TornSoup(const PointCloud& body) {
  PointCloud soup;
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    const int first = static_cast<int>(soup.size());
    for (int i = 0; i < 3; ++i) {
      const double off = 1e-8 * static_cast<double>((3 * t + i) % 7);
      soup.points.push_back(body.points[body.triangles[t][i]] + off * Eigen::Vector3d::Ones());
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

int BorderPoints(const PointCloud& cloud) {
  const SurfaceTopology topology = BuildTopology(cloud);
  return static_cast<int>(
      std::count(topology.is_border.begin(), topology.is_border.end(), char(1)));
}

TEST(Repair, ClosesGapsOfRoundingErrors) {
  const PointCloud body = MakeSyntheticShape(SyntheticShape::kHeart, 1500, 1.0);
  PointCloud soup = TornSoup(body);
  ASSERT_GT(BorderPoints(soup), 1000);
  const std::size_t points = soup.size();
  const PointCloud before = soup;
  EXPECT_EQ(RepairCloud("it", &soup).size(), 1u);
  EXPECT_EQ(BorderPoints(soup), BorderPoints(body));
  ASSERT_EQ(soup.size(), points);
  for (std::size_t p = 0; p < points; ++p) {
    EXPECT_LT((soup.points[p] - before.points[p]).norm(), 2e-7);
  }
}

TEST(Repair, RemovesFacesThatAddNothing) {
  PointCloud body = MakeSyntheticShape(SyntheticShape::kHeart, 1500, 1.0);
  const std::vector<std::array<int, 3>> triangles = body.triangles;
  body.triangles.push_back({triangles[4][2], triangles[4][1], triangles[4][0]});
  const int last = static_cast<int>(body.size());
  for (int i = 0; i < 3; ++i) body.points.emplace_back(0.01 * i, 2.0, 0.0);
  body.normals.clear();
  body.triangles.push_back({last, last + 1, last + 2});
  EXPECT_EQ(RepairCloud("it", &body).size(), 2u);
  EXPECT_EQ(body.triangles, triangles);
}

TEST(Repair, LeavesAWholeBodyAsItIs) {
  PointCloud body = MakeSyntheticShape(SyntheticShape::kHeart, 1500, 1.0);
  const PointCloud before = body;
  EXPECT_TRUE(RepairCloud("it", &body).empty());
  EXPECT_EQ(body.points, before.points);
  EXPECT_EQ(body.triangles, before.triangles);
}

}  // namespace
}  // namespace ceres_ed
