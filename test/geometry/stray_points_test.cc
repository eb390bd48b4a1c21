#include <ceres_ed/geometry/stray_points.h>

#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

const Eigen::Vector3d kAway(0.0, 0.0, 500.0);

// Returns a sheet of 1 x 1 cells around (0, 0, 500).
PointCloud DistantSheet() {
  PointCloud mesh = MakeGridMesh(20, 20);
  for (Eigen::Vector3d& point : mesh.points) point += kAway;
  return mesh;
}

TEST(UnmeasuredPoints, AreThoseAtTheOriginOfABareCloud) {
  PointCloud cloud = DistantSheet();
  cloud.triangles.clear();
  EXPECT_TRUE(UnmeasuredPoints(cloud).empty());
  cloud.points[3].setZero();
  EXPECT_TRUE(UnmeasuredPoints(cloud).empty()) << "one point may be there by chance";
  cloud.points[17].setZero();
  EXPECT_EQ(UnmeasuredPoints(cloud), (std::vector<int>{3, 17}));
}

TEST(UnmeasuredPoints, AreThoseOfAMeshToWhichLongEdgesLead) {
  PointCloud mesh = DistantSheet();
  for (const int p : {0, 1, 20, 210}) mesh.points[p].setZero();
  EXPECT_EQ(UnmeasuredPoints(mesh), (std::vector<int>{0, 1, 20, 210}));
}

TEST(UnmeasuredPoints, AreNoneWhereAMeshPassesThroughTheOrigin) {
  std::vector<int> source;
  // Each corner of each triangle is a point of its own, so that several are at the origin.
  const PointCloud mesh = Unweld(MakeGridMesh(5, 5), &source);
  EXPECT_TRUE(UnmeasuredPoints(mesh).empty());
}

TEST(FarPoints, AreThoseBeyondTenTimesTheExtent) {
  PointCloud cloud = DistantSheet();
  EXPECT_TRUE(FarPoints(cloud).empty());
  cloud.points[5].z() += 5000.0;
  cloud.points[6].z() += 50.0;
  EXPECT_EQ(FarPoints(cloud), std::vector<int>{5});
}

TEST(FarPoints, AreNoneWhereMostPointsCoincide) {
  PointCloud cloud;
  cloud.points.assign(200, kAway);
  cloud.points[0].setZero();
  EXPECT_TRUE(FarPoints(cloud).empty());
  EXPECT_TRUE(FarPoints(PointCloud()).empty());
}

TEST(RemovePoints, KeepsTheOtherPointsAndTheirTriangles) {
  PointCloud mesh = MakeGridMesh(3, 2);
  mesh.normals.assign(6, Eigen::Vector3d::UnitZ());
  mesh.intensities = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5};
  const PointCloud before = mesh;
  EXPECT_EQ(RemovePoints({0}, &mesh), 2);
  ASSERT_EQ(mesh.size(), 5u);
  EXPECT_EQ(mesh.points[0], before.points[1]);
  EXPECT_EQ(mesh.intensities[4], 0.5);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  for (int t = 0; t < 2; ++t) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(mesh.triangles[t][k], before.triangles[t + 2][k] - 1);
  }
}

}  // namespace
}  // namespace ceres_ed
