#include <ceres_ed/geometry/kd_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// Returns all points, sorted by distance, then by index.
std::vector<Neighbor> BruteForce(const std::vector<Eigen::Vector3d>& points,
                                 const Eigen::Vector3d& query) {
  std::vector<Neighbor> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.push_back({static_cast<int>(i), (points[i] - query).squaredNorm()});
  }
  std::stable_sort(all.begin(), all.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.squared_distance < b.squared_distance;
  });
  return all;
}

void ExpectSame(const std::vector<Neighbor>& found, const std::vector<Neighbor>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].index, expected[i].index) << "place " << i;
    EXPECT_DOUBLE_EQ(found[i].squared_distance, expected[i].squared_distance) << "place " << i;
  }
}

// Returns points with integer coordinates, each of them twice, so that nearly every search has
// ties.
std::vector<Eigen::Vector3d> TiedPoints() {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 2 * 125; ++i) {
    const int cell = (i * 37) % 125;
    points.emplace_back(cell % 5, cell / 5 % 5, cell / 25);
  }
  return points;
}

TEST(KdTree, KNearestEqualsBruteForceOnRandomPoints) {
  const std::vector<Eigen::Vector3d> points = RandomPoints(500, 1);
  const KdTree tree(points);
  std::vector<Neighbor> found;
  for (const Eigen::Vector3d& query : RandomPoints(100, 2, 1.5)) {
    std::vector<Neighbor> expected = BruteForce(points, query);
    expected.resize(7);
    EXPECT_EQ(tree.KNearest(query, 7, &found), 7);
    ExpectSame(found, expected);
    EXPECT_EQ(tree.Nearest(query).index, expected[0].index);
  }
}

TEST(KdTree, BreaksTiesByTheLowestIndex) {
  const std::vector<Eigen::Vector3d> points = TiedPoints();
  const KdTree tree(points);
  std::vector<Neighbor> found;
  for (const Eigen::Vector3d& query : TiedPoints()) {
    for (const double shift : {0.0, 0.5}) {
      const Eigen::Vector3d q = query + Eigen::Vector3d(shift, shift, 0.0);
      std::vector<Neighbor> expected = BruteForce(points, q);
      EXPECT_EQ(tree.Nearest(q).index, expected[0].index);
      expected.resize(5);
      tree.KNearest(q, 5, &found);
      ExpectSame(found, expected);
    }
  }
}

TEST(KdTree, RadiusSearchEqualsBruteForceAndIncludesTheRadius) {
  const std::vector<Eigen::Vector3d> points = TiedPoints();
  const KdTree tree(points);
  std::vector<Neighbor> found;
  for (const Eigen::Vector3d& query : {Eigen::Vector3d(2, 2, 2), Eigen::Vector3d(0.3, 4.2, 1.1)}) {
    for (const double radius : {0.0, 1.0, 2.0, 2.5}) {
      std::vector<Neighbor> expected = BruteForce(points, query);
      const auto within = [&](const Neighbor& n) { return n.squared_distance <= radius * radius; };
      expected.resize(std::count_if(expected.begin(), expected.end(), within));
      EXPECT_EQ(tree.RadiusSearch(query, radius, &found), static_cast<int>(expected.size()));
      ExpectSame(found, expected);
    }
  }
}

TEST(KdTree, NearestWithinIncludesTheDistanceAndStopsThere) {
  const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {3, 0, 0}};
  const KdTree tree(points);
  EXPECT_EQ(tree.NearestWithin({5, 0, 0}, 2.0).index, 1);
  EXPECT_EQ(tree.NearestWithin({5, 0, 0}, 1.999).index, -1);
  EXPECT_EQ(tree.NearestWithin({3, 0, 0}, 0.0).index, 1);
  EXPECT_EQ(tree.NearestWithin({3, 0, 0}, -1.0).index, -1);
  EXPECT_TRUE(std::isinf(tree.NearestWithin({5, 0, 0}, 1.0).squared_distance));
}

TEST(KdTree, AHintChangesNothing) {
  const std::vector<Eigen::Vector3d> points = TiedPoints();
  const KdTree tree(points);
  for (const Eigen::Vector3d& query : RandomPoints(50, 5, 3.0)) {
    const Eigen::Vector3d rounded = query.array().round();
    for (const Eigen::Vector3d& q : {query, rounded}) {
      const Neighbor expected = tree.NearestWithin(q, 1.5);
      for (const int hint : {0, 249, expected.index}) {
        EXPECT_EQ(tree.NearestWithin(q, 1.5, hint).index, expected.index);
        EXPECT_EQ(tree.NearestWithin(q, 1.5, hint).squared_distance, expected.squared_distance);
      }
    }
  }
}

// Every point occurs once, even if many are at the same place.
TEST(KdTree, HasAllPointsInItsOrder) {
  std::vector<Eigen::Vector3d> points = RandomPoints(100, 6);
  points.resize(150, points.front());
  KdTree tree(points);
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<int> order = tree.order();
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, all);
  for (Eigen::Vector3d& point : points) point *= -2.0;
  tree.Update();
  order = tree.order();
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, all);
}

TEST(KdTree, AnUpdateFindsPointsWhereTheyAreNow) {
  std::vector<Eigen::Vector3d> points = RandomPoints(300, 6);
  KdTree tree(points);
  points = RandomPoints(300, 7, 2.0);
  tree.Update();
  std::vector<Neighbor> found;
  for (const Eigen::Vector3d& query : RandomPoints(100, 8, 2.5)) {
    std::vector<Neighbor> expected = BruteForce(points, query);
    expected.resize(6);
    tree.KNearest(query, 6, &found);
    ExpectSame(found, expected);
    EXPECT_EQ(tree.NearestWithin(query, 1e3, 12).index, expected[0].index);
  }
}

TEST(KdTree, FindsNothingInAnEmptyTreeOrForAQueryThatIsNotFinite) {
  const std::vector<Eigen::Vector3d> none;
  const KdTree empty(none);
  EXPECT_FALSE(empty.Nearest({0, 0, 0}).found());
  std::vector<Neighbor> found;
  EXPECT_EQ(empty.KNearest({0, 0, 0}, 3, &found), 0);
  EXPECT_EQ(empty.RadiusSearch({0, 0, 0}, 3.0, &found), 0);
  const std::vector<Eigen::Vector3d> points = RandomPoints(20, 3);
  const KdTree tree(points);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tree.Nearest({nan, 0, 0}).found());
  EXPECT_EQ(tree.KNearest({0, nan, 0}, 3, &found), 0);
}

TEST(KdTree, FindsAllPointsWhenThereAreFewerThanAsked) {
  const std::vector<Eigen::Vector3d> points = RandomPoints(3, 4);
  const KdTree tree(points);
  Neighbor found[10];
  EXPECT_EQ(tree.KNearest({0, 0, 0}, 10, found), 3);
}

}  // namespace
}  // namespace ceres_ed
