#include "ceres_ed/pcl/pcl_conversions.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/point_types.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::vector<Eigen::Vector3d> Shifted(std::vector<Eigen::Vector3d> points) {
  for (Eigen::Vector3d& point : points) point += Eigen::Vector3d(1, 2, 3);
  return points;
}

TEST(PclConversions, PlainPointsComeAndGo) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int i = 0; i < 5; ++i) cloud.push_back({0.1F * static_cast<float>(i), 1.5F, -2.0F});
  const StatusOr<LoadedCloud> loaded = FromPcl(cloud);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  ASSERT_EQ(loaded->cloud.size(), 5u);
  EXPECT_EQ(loaded->cloud.points[3], Eigen::Vector3d(0.1F * 3.0F, 1.5, -2.0));
  EXPECT_FALSE(loaded->cloud.HasNormals());

  pcl::PointCloud<pcl::PointXYZ> moved;
  ASSERT_TRUE(ToPcl(*loaded, Shifted(loaded->cloud.points), nullptr, &moved).ok());
  ASSERT_EQ(moved.size(), 5u);
  EXPECT_FLOAT_EQ(moved[3].x, 1.3F);
  EXPECT_FLOAT_EQ(moved[3].z, 1.0F);
}

TEST(PclConversions, ColoursNormalsAndPointsThatAreNotFiniteSurvive) {
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  for (int i = 0; i < 4; ++i) {
    pcl::PointXYZRGBNormal point;
    point.x = static_cast<float>(i);
    point.y = i == 2 ? kNan : 0.0F;
    point.z = 7.0F;
    point.r = static_cast<std::uint8_t>(200 + i);
    point.g = 100;
    point.b = 3;
    point.normal_x = 0.0F;
    point.normal_y = 2.0F;
    point.normal_z = 0.0F;
    point.curvature = 0.25F;
    cloud.push_back(point);
  }
  const StatusOr<LoadedCloud> loaded = FromPcl(cloud);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_THAT(loaded->vertex_of_point, ElementsAre(0, 1, 3));
  EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("1 point with coordinates")));
  EXPECT_EQ(loaded->cloud.normals[0], Eigen::Vector3d(0, 1, 0));
  EXPECT_NEAR(loaded->cloud.intensities[0], (0.299 * 200 + 0.587 * 100 + 0.114 * 3) / 255, 1e-12);

  const std::vector<Eigen::Vector3d> normals(3, Eigen::Vector3d::UnitX());
  pcl::PointCloud<pcl::PointXYZRGBNormal> moved;
  ASSERT_TRUE(ToPcl(*loaded, Shifted(loaded->cloud.points), &normals, &moved).ok());
  ASSERT_EQ(moved.size(), 4u);
  EXPECT_EQ(moved[3].x, 4.0F);
  EXPECT_EQ(moved[3].r, 203);
  EXPECT_EQ(moved[3].g, 100);
  EXPECT_EQ(moved[3].b, 3);
  EXPECT_EQ(moved[3].normal_x, 1.0F);
  EXPECT_EQ(moved[3].curvature, 0.25F);
  // The point that was left out is where it was.
  EXPECT_TRUE(std::isnan(moved[2].y));
  EXPECT_EQ(moved[2].x, 2.0F);
}

TEST(PclConversions, RowsAndColumnsOfASensorsCloudStay) {
  pcl::PointCloud<pcl::PointXYZ> cloud(3, 2, pcl::PointXYZ(1, 2, 3));
  const StatusOr<LoadedCloud> loaded = FromPcl(cloud);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  pcl::PointCloud<pcl::PointXYZ> moved;
  ASSERT_TRUE(ToPcl(*loaded, loaded->cloud.points, nullptr, &moved).ok());
  EXPECT_EQ(moved.width, 3u);
  EXPECT_EQ(moved.height, 2u);
}

TEST(PclConversions, MeshesKeepTheirPolygons) {
  pcl::PolygonMesh mesh;
  pcl::PointCloud<pcl::PointXYZ> points;
  points.push_back({0, 0, 0});
  points.push_back({1, 0, 0});
  points.push_back({1, 1, 0});
  points.push_back({0, 1, 0});
  pcl::toPCLPointCloud2(points, mesh.cloud);
  mesh.polygons.resize(2);
  mesh.polygons[0].vertices = {0, 1, 2, 3};
  mesh.polygons[1].vertices = {0, 2, 1};
  const StatusOr<LoadedCloud> loaded = FromPcl(mesh);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_EQ(loaded->cloud.triangles.size(), 3u);

  pcl::PolygonMesh moved;
  ASSERT_TRUE(ToPcl(*loaded, Shifted(loaded->cloud.points), nullptr, &moved).ok());
  ASSERT_EQ(moved.polygons.size(), 2u);
  EXPECT_THAT(moved.polygons[0].vertices, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(moved.polygons[1].vertices, ElementsAre(0, 2, 1));
  pcl::PointCloud<pcl::PointXYZ> moved_points;
  pcl::fromPCLPointCloud2(moved.cloud, moved_points);
  EXPECT_EQ(moved_points[2].z, 3.0F);

  mesh.polygons[1].vertices = {0, 2, 4};
  EXPECT_EQ(FromPcl(mesh).status().message(),
            "pcl::PolygonMesh: face 1 names vertex 4, the file has 4");
}

TEST(PclConversions, CloudsThatContradictThemselvesAreErrors) {
  pcl::PointCloud<pcl::PointXYZ> points(10, 1, pcl::PointXYZ(1, 2, 3));
  pcl::PCLPointCloud2 good;
  pcl::toPCLPointCloud2(points, good);
  ASSERT_TRUE(FromPcl(good).ok());

  pcl::PCLPointCloud2 bad = good;
  bad.width = 4000000000U;
  EXPECT_THAT(FromPcl(bad).status().message(), HasSubstr("expected 4000000000 points"));
  bad = good;
  bad.fields[1].offset = 4000000000U;
  EXPECT_THAT(FromPcl(bad).status().message(), HasSubstr("field 'y' lies outside"));
  bad = good;
  bad.fields[1].count = 4000000000U;
  EXPECT_THAT(FromPcl(bad).status().message(), HasSubstr("field 'y' lies outside"));
  bad = good;
  bad.fields[1].name = "x";
  EXPECT_THAT(FromPcl(bad).status().message(), HasSubstr("two fields 'x'"));
  bad = good;
  bad.fields[1].datatype = 99;
  EXPECT_THAT(FromPcl(bad).status().message(), HasSubstr("field 'y' has"));
  EXPECT_THAT(FromPcl(pcl::PCLPointCloud2()).status().message(), HasSubstr("no vertices"));
}

}  // namespace
}  // namespace ceres_ed
