#include <ceres_ed/report/view/decimation.h>

#include <algorithm>
#include <set>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

struct Mesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
};

// A square of side 1 with `side` x `side` points.
Mesh Square(int side) {
  Mesh mesh;
  for (int v = 0; v < side; ++v) {
    for (int u = 0; u < side; ++u) {
      mesh.points.emplace_back(double(u) / (side - 1), double(v) / (side - 1), 0.0);
      if (u == 0 || v == 0) continue;
      const int at = v * side + u;
      mesh.triangles.push_back({at - side - 1, at - side, at});
      mesh.triangles.push_back({at - side - 1, at, at - 1});
    }
  }
  return mesh;
}

double Area(const std::vector<Eigen::Vector3d>& points, const std::array<int, 3>& t) {
  return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).z();
}

TEST(Decimation, KeepsEverythingOfASmallSurface) {
  const Mesh mesh = Square(5);
  const Decimation result = Decimate(mesh.points, mesh.triangles, 25);
  ASSERT_EQ(result.kept.size(), 25U);
  for (int i = 0; i < 25; ++i) EXPECT_EQ(result.kept[i], i);
  EXPECT_EQ(result.triangles, mesh.triangles);
}

TEST(Decimation, KeepsAboutAsManyPointsAsWanted) {
  const Mesh mesh = Square(200);
  for (const int wanted : {300, 3000, 20000}) {
    const std::size_t kept = Decimate(mesh.points, mesh.triangles, wanted).kept.size();
    EXPECT_GT(kept, 0.6 * wanted);
    EXPECT_LE(kept, 1.1 * wanted);
  }
}

TEST(Decimation, TrianglesStillCoverTheSquareAndKeepTheirSide) {
  const Mesh mesh = Square(100);
  const Decimation result = Decimate(mesh.points, mesh.triangles, 900);
  std::vector<Eigen::Vector3d> points;
  for (const int point : result.kept) points.push_back(mesh.points[point]);
  double area = 0.0;
  for (const std::array<int, 3>& triangle : result.triangles) area += Area(points, triangle);
  EXPECT_NEAR(area, 1.0, 0.1);
}

TEST(Decimation, NoTriangleIsEmptyOrTwice) {
  const Mesh mesh = Square(60);
  std::set<std::array<int, 3>> seen;
  const Decimation result = Decimate(mesh.points, mesh.triangles, 200);
  for (std::array<int, 3> triangle : result.triangles) {
    std::sort(triangle.begin(), triangle.end());
    EXPECT_LT(triangle[0], triangle[1]);
    EXPECT_LT(triangle[1], triangle[2]);
    EXPECT_TRUE(seen.insert(triangle).second);
  }
}

TEST(Decimation, KeepsThePointsThatMustStay) {
  const Mesh mesh = Square(60);
  const std::vector<int> must = {0, 1, 2, 3599};
  const Decimation result = Decimate(mesh.points, mesh.triangles, 100, must);
  EXPECT_TRUE(std::is_sorted(result.kept.begin(), result.kept.end()));
  for (const int point : must) {
    EXPECT_TRUE(std::binary_search(result.kept.begin(), result.kept.end(), point)) << point;
  }
}

TEST(Decimation, ManyPointsAtOnePlaceBecomeOne) {
  const std::vector<Eigen::Vector3d> points(1000, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(Decimate(points, {}, 10).kept.size(), 1U);
}

TEST(Decimation, AScatterInSpaceAndALineHaveFewEnoughPoints) {
  std::vector<Eigen::Vector3d> solid, line;
  for (int i = 0; i < 27000; ++i) {
    solid.emplace_back(i % 30, (i / 30) % 30, i / 900);
    line.emplace_back(i * 1e-3, 0.0, 0.0);
  }
  EXPECT_LE(Decimate(solid, {}, 500).kept.size(), 550U);
  EXPECT_LE(Decimate(line, {}, 500).kept.size(), 550U);
}

TEST(Decimation, DoesNotDependOnTheUnit) {
  const Mesh mesh = Square(80);
  std::vector<Eigen::Vector3d> scaled = mesh.points;
  for (Eigen::Vector3d& point : scaled) point *= 1024.0;
  EXPECT_EQ(Decimate(mesh.points, mesh.triangles, 500).kept,
            Decimate(scaled, mesh.triangles, 500).kept);
}

}  // namespace
}  // namespace ceres_ed
