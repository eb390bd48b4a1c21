#include "ceres_ed/registration/matching.h"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// Returns a flat grid of (columns x rows) points, one unit apart, facing +z.
PointCloud MakeGrid(int columns, int rows, const Eigen::Vector3d& origin) {
  PointCloud grid;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) grid.points.push_back(origin + Eigen::Vector3d(c, r, 0.0));
  }
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const int a = r * columns + c;
      grid.triangles.push_back({a, a + 1, a + columns});
      grid.triangles.push_back({a + 1, a + columns + 1, a + columns});
    }
  }
  return grid;
}

std::vector<int> All(const PointCloud& cloud) {
  std::vector<int> indices(cloud.size());
  std::iota(indices.begin(), indices.end(), 0);
  return indices;
}

// Matches all points of a source at rest with some points of a target.
Matches MatchAtRest(const Surface& source,
                    const Surface& target,
                    const std::vector<int>& target_samples,
                    const MatchingOptions& options) {
  const std::vector<int> all = All(source.cloud());
  return MatchBothWays({&source, &all, &source.cloud().points, &source.cloud().normals},
                       target,
                       target_samples,
                       options);
}

Matches MatchAtRest(const Surface& source, const Surface& target, const MatchingOptions& options) {
  return MatchAtRest(source, target, All(target.cloud()), options);
}

TEST(Matching, FindsTheFootOfThePerpendicularBothWays) {
  // The source lies inside the outline of the target, 0.2 above it and between its points.
  const Surface source(MakeGrid(4, 4, {2.5, 2.5, 0.2}));
  const Surface target(MakeGrid(9, 9, {0.0, 0.0, 0.0}));
  const Matches matches = MatchAtRest(source, target, MatchingOptions());
  int forward = 0;
  for (const Correspondence& match : matches.correspondences) {
    const Eigen::Vector3d& point = source.cloud().points[match.point];
    EXPECT_LT((match.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(match.target.z(), 0.0, 1e-12);
    if ((match.target - point).head<2>().norm() < 1e-12) ++forward;
  }
  // All 16 source points, and in the other direction the four inner points that are not on the
  // border.
  EXPECT_EQ(forward, 16);
  EXPECT_GT(matches.inliers, 16);
  EXPECT_NEAR(matches.rms_plane, 0.2, 1e-12);
  EXPECT_EQ(matches.candidates, 16 + 81);
}

TEST(Matching, RejectsWhatLiesBeyondABorder) {
  // Two thirds of the source lie beyond the target's edge at x = 4.
  const Surface source(MakeGrid(9, 5, {2.0, 2.0, 0.1}));
  const Surface target(MakeGrid(5, 9, {0.0, 0.0, 0.0}));
  const Matches matches = MatchAtRest(source, target, MatchingOptions());
  ASSERT_GT(matches.inliers, 0);
  for (const Correspondence& match : matches.correspondences) {
    EXPECT_LT(source.cloud().points[match.point].x(), 4.5);
  }
}

TEST(Matching, RejectsNormalsThatDisagreeUnlessUnoriented) {
  const Surface source(MakeGrid(4, 4, {2.5, 2.5, 0.1}));
  PointCloud turned = MakeGrid(9, 9, {0.0, 0.0, 0.0});
  for (auto& triangle : turned.triangles) std::swap(triangle[0], triangle[1]);
  EXPECT_EQ(MatchAtRest(source, Surface(turned), MatchingOptions()).inliers, 0);
  turned.normals.assign(turned.size(), -Eigen::Vector3d::UnitZ());
  turned.normals_oriented = false;
  EXPECT_GE(MatchAtRest(source, Surface(turned), MatchingOptions()).inliers, 16);
}

TEST(Matching, RejectsWhatIsTooFar) {
  const Surface source(MakeGrid(4, 4, {2.5, 2.5, 0.5}));
  const Surface target(MakeGrid(9, 9, {0.0, 0.0, 0.0}));
  MatchingOptions options;
  options.max_distance = 0.4;
  EXPECT_EQ(MatchAtRest(source, target, options).inliers, 0);

  // One point far above many near ones is rejected by its deviation, and accepted within the
  // resolution.
  PointCloud bent = MakeGrid(4, 4, {2.5, 2.5, 0.1});
  bent.points[5].z() = 2.0;
  bent.normals.assign(bent.size(), Eigen::Vector3d::UnitZ());
  const Surface bent_source(bent);
  const auto has_point_5 = [](const Matches& matches) {
    for (const Correspondence& match : matches.correspondences) {
      if (match.point == 5 && match.target.z() == 0.0) return true;
    }
    return false;
  };
  options = MatchingOptions();
  options.max_deviations = 3.0;
  const Matches by_deviation = MatchAtRest(bent_source, target, std::vector<int>(), options);
  EXPECT_FALSE(has_point_5(by_deviation));
  EXPECT_EQ(by_deviation.inliers, 15);
  options.resolution = 2.5;
  EXPECT_TRUE(has_point_5(MatchAtRest(bent_source, target, std::vector<int>(), options)));
}

// Returns random points on the unit sphere with their normals.
PointCloud MakeBareSphere(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gaussian;
  PointCloud sphere;
  for (int i = 0; i < count; ++i) {
    const double x = gaussian(random);
    const double y = gaussian(random);
    sphere.points.push_back(Eigen::Vector3d(x, y, gaussian(random)).normalized());
  }
  sphere.normals = sphere.points;
  return sphere;
}

TEST(Matching, TakesTheNormalHalfWayBetweenThoseOfTheTwoSurfaces) {
  const Surface source(MakeBareSphere(150, 1));
  const Surface target(MakeBareSphere(150, 2));
  const Matches matches = MatchAtRest(source, target, MatchingOptions());
  ASSERT_GT(matches.inliers, 200);
  for (const Correspondence& match : matches.correspondences) {
    const Eigen::Vector3d half_way = source.cloud().normals[match.point] + match.target;
    EXPECT_LT((match.normal - half_way.normalized()).norm(), 1e-12);
  }
  // Points of the same sphere lie on each other's symmetric planes: (p - q).(p + q) = 0.
  EXPECT_GT(matches.rms_point, 0.05);
  EXPECT_LT(matches.rms_plane, 1e-12);
}

TEST(Matching, TakesThatNormalUpToSignWhereSignsAreUnknown) {
  PointCloud unsure = MakeBareSphere(150, 2);
  unsure.normals_oriented = false;
  for (std::size_t p = 0; p < unsure.size(); p += 2) unsure.normals[p] = -unsure.normals[p];
  const Surface source(MakeBareSphere(150, 1));
  const Matches expected = MatchAtRest(source, Surface(MakeBareSphere(150, 2)), MatchingOptions());
  const Matches matches = MatchAtRest(source, Surface(unsure), MatchingOptions());
  EXPECT_EQ(matches.inliers, expected.inliers);
  EXPECT_LT(matches.rms_plane, 1e-12);
}

// Returns the pairs of one target point that faces +z with a source grid in z = 0, not farther
// apart than `reach` as the matching measures it.
Matches MatchBack(const Eigen::Vector3d& target_point, double reach) {
  PointCloud cloud;
  cloud.points = {target_point};
  cloud.normals = {Eigen::Vector3d::UnitZ()};
  MatchingOptions options;
  options.max_deviations = 1e-9;
  options.resolution = reach;
  return MatchAtRest(Surface(MakeGrid(7, 7, {0.0, 0.0, 0.0})), Surface(cloud), {0}, options);
}

TEST(Matching, CountsNoDistanceWithinTheDiscOfASourcePoint) {
  // An inner point represents an area of 1, a disc of radius 0.56, which contains (0.3, 0.4).
  for (const double height : {0.0, 0.2}) {
    EXPECT_EQ(MatchBack({3.3, 3.4, height}, height / 2.0).inliers, height > 0.0 ? 0 : 1);
    const Matches matches = MatchBack({3.3, 3.4, height}, height + 1e-6);
    ASSERT_EQ(matches.inliers, 1);
    EXPECT_EQ(matches.correspondences[0].point, 3 * 7 + 3);
    // The symmetric plane passes through the target point itself.
    EXPECT_LT((matches.correspondences[0].target - Eigen::Vector3d(3.3, 3.4, height)).norm(),
              1e-12);
    EXPECT_NEAR(matches.rms_plane, height, 1e-12);
  }
}

TEST(Matching, CountsTheDistanceBeyondThatDiscFromItsRim) {
  // The middle of a cell is sqrt(1/2) from its corners.
  const double distance = std::sqrt(0.5) - std::sqrt(1.0 / M_PI);
  EXPECT_EQ(MatchBack({3.5, 3.5, 0.0}, distance - 1e-6).inliers, 0);
  EXPECT_EQ(MatchBack({3.5, 3.5, 0.0}, distance + 1e-6).inliers, 1);
}

TEST(Matching, FindsTheSameWithTheMemoryOfOtherPlaces) {
  const Surface source(MakeBareSphere(150, 1));
  const Surface target(MakeBareSphere(150, 2));
  std::vector<Eigen::Vector3d> points = source.cloud().points;
  const std::vector<int> all = All(source.cloud());
  const MovedSource moving{&source, &all, &points, &source.cloud().normals};
  MatchMemory memory;
  MatchBothWays(moving, target, all, MatchingOptions(), &memory);
  for (Eigen::Vector3d& point : points) point += Eigen::Vector3d(0.3, -0.1, 0.2) * point.x();
  const Matches with = MatchBothWays(moving, target, all, MatchingOptions(), &memory);
  const Matches without = MatchBothWays(moving, target, all, MatchingOptions());
  ASSERT_EQ(with.inliers, without.inliers);
  for (int i = 0; i < with.inliers; ++i) {
    EXPECT_EQ(with.correspondences[i].point, without.correspondences[i].point);
    EXPECT_EQ(with.correspondences[i].target, without.correspondences[i].target);
  }
}

TEST(Matching, WeighsEachDirectionByAreaToAtMostOne) {
  const Surface source(MakeGrid(6, 6, {1.3, 1.3, 0.1}));
  const Surface target(MakeGrid(9, 9, {0.0, 0.0, 0.0}));
  const Matches forward = MatchAtRest(source, target, std::vector<int>(), MatchingOptions());
  double sum = 0.0;
  for (const Correspondence& match : forward.correspondences) sum += match.weight;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // A corner represents less area than an inner point.
  EXPECT_LT(source.relative_areas()[0], source.relative_areas()[7]);
}

TEST(Matching, NothingIsUnmatchedOnACopyAndAllOutOfReach) {
  const Surface target(MakeGrid(9, 9, {0.0, 0.0, 0.0}));
  const std::vector<int> all = All(target.cloud());
  const MovedSource same{&target, &all, &target.cloud().points, &target.cloud().normals};
  EXPECT_NEAR(FindUnmatched(same, target, all, 0.1, MatchingOptions()).Mean(), 0.0, 1e-12);
  std::vector<Eigen::Vector3d> lifted = target.cloud().points;
  for (Eigen::Vector3d& point : lifted) point.z() += 0.1;
  const MovedSource above{&target, &all, &lifted, &target.cloud().normals};
  // With d = width, d^2 / (d^2 + width^2) = 1 / 2.
  EXPECT_NEAR(FindUnmatched(above, target, all, 0.1, MatchingOptions()).Mean(), 0.5, 1e-9);
  MatchingOptions near;
  near.max_distance = 0.01;
  EXPECT_EQ(FindUnmatched(above, target, all, 0.1, near).Mean(), 1.0);
}

TEST(Matching, IsTheSameOnTwoThreads) {
  const Surface source(MakeGrid(6, 6, {1.3, 1.4, 0.3}));
  const Surface target(MakeGrid(9, 9, {0.0, 0.0, 0.0}));
  MatchingOptions two;
  two.num_threads = 2;
  const Matches a = MatchAtRest(source, target, MatchingOptions());
  const Matches b = MatchAtRest(source, target, two);
  ASSERT_EQ(a.inliers, b.inliers);
  for (int i = 0; i < a.inliers; ++i) {
    EXPECT_EQ(a.correspondences[i].point, b.correspondences[i].point);
    EXPECT_EQ(a.correspondences[i].target, b.correspondences[i].target);
  }
}

TEST(SamplePoints, LeavesOutIsolatedVerticesAndKeepsToTheCount) {
  PointCloud grid = MakeGrid(6, 6, {0.0, 0.0, 0.0});
  grid.points.emplace_back(50.0, 0.0, 0.0);
  const Surface surface(grid);
  EXPECT_EQ(SamplePoints(surface, 1000).size(), 36u);
  const std::vector<int> ten = SamplePoints(surface, 10);
  EXPECT_EQ(ten.size(), 10u);
  for (const int point : ten) EXPECT_NE(point, 36);
}

TEST(Unmatched, TotalWeighsTheSurfaceThatIsExplainedBetter) {
  EXPECT_DOUBLE_EQ((Unmatched{0.9, 0.1}).Total(), 0.26);
  EXPECT_DOUBLE_EQ((Unmatched{0.1, 0.9}).Total(), 0.26);
}

}  // namespace
}  // namespace ceres_ed
