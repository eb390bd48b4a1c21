#include <ceres_ed/registration/intrinsic/coarse_mesh.h>
#include <ceres_ed/registration/intrinsic/intrinsic_match.h>

#include <algorithm>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>
#include <test/registration/walker.h>

namespace ceres_ed {
namespace {

// The legs cross.
const WalkerPose kPose = {{1.3, 1.0, -1.0, -1.3}, {0.4, -0.4, 0.4, -0.4}, -1.0};
// The legs keep clear of each other, so that distances in space tell them apart.
const WalkerPose kOpenPose = {{-0.9, 0.6, 0.9, -0.6}, {-0.2, 0.2, -0.2, 0.2}, 1.0};

// Returns the mean distance between the places of the matches and where the points really are, in
// percent of the diagonal.
double MeanMatchError(const IntrinsicMatches& matches, const PointCloud& truth) {
  double sum = 0.0;
  for (const Correspondence& match : matches.correspondences) {
    sum += (match.target - truth.points[match.point]).norm();
  }
  return 100.0 * sum / matches.correspondences.size() / BoundingBox(truth.points).diagonal().norm();
}

TEST(CoarseMesh, IsClosedWhereTheSurfaceIs) {
  const Surface sphere(MakeSphereMesh(5));
  const std::vector<CoarseMesh> parts = BuildCoarseMeshes(sphere, 800);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(parts[0].size(), 800, 200);
  // Euler's formula for a closed surface.
  EXPECT_EQ(parts[0].triangles.size(), 2u * parts[0].size() - 4);
  EXPECT_NEAR(parts[0].area, 4.0 * M_PI, 0.15);
  int outward = 0;
  const std::vector<Eigen::Vector3d> normals = CoarseNormals(parts[0]);
  for (int v = 0; v < parts[0].size(); ++v) outward += normals[v].dot(parts[0].positions[v]) > 0.9;
  EXPECT_EQ(outward, parts[0].size());
}

TEST(CoarseMesh, HasThePartsOfConsiderableAreaTheLargestFirst) {
  const PointCloud sphere = MakeSphereMesh(4);
  PointCloud small = sphere;
  for (Eigen::Vector3d& point : small.points) point *= 0.5;
  PointCloud tiny = sphere;
  for (Eigen::Vector3d& point : tiny.points) point *= 0.1;
  const Eigen::Vector3d apart(3.0, 0.0, 0.0);
  const Surface surface(Append(Append(small, sphere, apart), tiny, -apart));
  const std::vector<CoarseMesh> parts = BuildCoarseMeshes(surface, 1000);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].area / parts[1].area, 4.0, 0.3);
}

TEST(IntrinsicMatches, FindTheLimbsInAnyPose) {
  const PointCloud source = MakeWalker(3000);
  const PointCloud truth = MoveWalker(kPose, source);
  const Surface moved(MoveWalker(kPose, MakeWalker(2500)));
  const std::vector<IntrinsicMatches> found = MatchIntrinsically(Surface(source), moved);
  ASSERT_FALSE(found.empty());
  EXPECT_GT(found[0].orientation, 0.75);
  EXPECT_GT(found[0].correspondences.size(), 700u);
  // The vertices that are matched are more than 2 % apart.
  EXPECT_LT(MeanMatchError(found[0], truth), 2.5);
}

TEST(IntrinsicMatches, DoNotSwapLeftAndRight) {
  const PointCloud source = MakeWalker(3000);
  PointCloud mirrored = MoveWalker(kPose, source);
  for (Eigen::Vector3d& point : mirrored.points) point.x() = -point.x();
  for (std::array<int, 3>& t : mirrored.triangles) std::swap(t[1], t[2]);
  // The walker itself is symmetric, so that its mirror image in another pose is that walker with
  // its left limbs for its right ones: vertices are not to be matched to their own images.
  const std::vector<IntrinsicMatches> found =
      MatchIntrinsically(Surface(source), Surface(mirrored));
  ASSERT_FALSE(found.empty());
  EXPECT_GT(found[0].orientation, 0.75);
  EXPECT_GT(MeanMatchError(found[0], mirrored), 5.0);
}

TEST(IntrinsicMatches, OfBarePointsAreThoseOfTheirSurface) {
  const PointCloud source = MakeWalker(3000);
  PointCloud points = MoveWalker(kOpenPose, MakeWalker(9000));
  points.triangles.clear();
  const std::vector<IntrinsicMatches> found = MatchIntrinsically(Surface(source), Surface(points));
  ASSERT_FALSE(found.empty());
  const PointCloud truth = MoveWalker(kOpenPose, source);
  double best = 100.0;
  for (const IntrinsicMatches& matches : found) {
    best = std::min(best, MeanMatchError(matches, truth));
  }
  EXPECT_LT(best, 3.0);
}

TEST(IntrinsicMatches, DoNotDependOnUnitsAndAreTheSameAtEachCall) {
  const PointCloud source = MakeWalker(2000);
  PointCloud target = MoveWalker(kPose, source);
  const std::vector<IntrinsicMatches> found = MatchIntrinsically(Surface(source), Surface(target));
  const std::vector<IntrinsicMatches> again = MatchIntrinsically(Surface(source), Surface(target));
  ASSERT_FALSE(found.empty());
  ASSERT_EQ(found.size(), again.size());
  PointCloud larger = source;
  for (PointCloud* cloud : {&larger, &target}) {
    for (Eigen::Vector3d& point : cloud->points) point *= 1024.0;
  }
  const std::vector<IntrinsicMatches> scaled = MatchIntrinsically(Surface(larger), Surface(target));
  ASSERT_EQ(found.size(), scaled.size());
  for (std::size_t m = 0; m < found.size(); ++m) {
    ASSERT_EQ(found[m].correspondences.size(), again[m].correspondences.size());
    ASSERT_EQ(found[m].correspondences.size(), scaled[m].correspondences.size());
    for (std::size_t i = 0; i < found[m].correspondences.size(); ++i) {
      const Correspondence& match = found[m].correspondences[i];
      EXPECT_EQ(match.target, again[m].correspondences[i].target);
      EXPECT_EQ(1024.0 * match.target, scaled[m].correspondences[i].target);
    }
  }
}

TEST(IntrinsicMatches, AreNoneBetweenAWholeAndOneSideOfIt) {
  const PointCloud source = MakeWalker(3000);
  PointCloud half = source;
  const auto is_right = [&](const std::array<int, 3>& t) { return source.points[t[0]].y() < 0.02; };
  half.triangles.erase(std::remove_if(half.triangles.begin(), half.triangles.end(), is_right),
                       half.triangles.end());
  EXPECT_TRUE(MatchIntrinsically(Surface(source), Surface(half)).empty());
}

TEST(IntrinsicMatches, AreNoneOfSurfacesOfFewPoints) {
  PointCloud triangle;
  triangle.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  PointCloud points = triangle;
  points.triangles.clear();
  EXPECT_TRUE(MatchIntrinsically(Surface(triangle), Surface(triangle)).empty());
  EXPECT_TRUE(MatchIntrinsically(Surface(points), Surface(triangle)).empty());
  PointCloud one;
  one.points.assign(5, Eigen::Vector3d::Ones());
  EXPECT_TRUE(MatchIntrinsically(Surface(one), Surface(triangle)).empty());
}

}  // namespace
}  // namespace ceres_ed
