#include "ceres_ed/io/results/live_cloud_io.h"

#include <ceres_ed/io/cloud_io.h>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;

TEST(LiveCloud, ReadsBackAsWritten) {
  const TemporaryDirectory dir;
  std::vector<LivePoint> points(2);
  points[0] = {{1.5f, -2.25f, 0.1f}, 2147483647, 0, {1e-20f, 3.0f, -4.0f}, 0.75f, 12};
  points[1] = {{0.0f, 7.0f, 8.0f}, 256, 65535, {9.0f, 10.0f, 11.0f}, 1.0f, 65536};
  ASSERT_TRUE(WriteLiveCloud(dir / "live.ply", points).ok());
  const StatusOr<LoadedCloud> loaded = LoadCloud(dir / "live.ply");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  const PlyElement& vertices = *loaded->document.Find("vertex");
  std::vector<std::string> names;
  for (const PlyProperty& property : vertices.properties) names.push_back(property.name);
  EXPECT_THAT(
      names,
      ElementsAre("x", "y", "z", "id", "birth_frame", "bx", "by", "bz", "stability", "last_seen"));
  EXPECT_EQ(loaded->cloud.points[0], Eigen::Vector3d(1.5, -2.25, 0.1f));
  EXPECT_THAT(vertices.Find("id")->values, ElementsAre(2147483647.0, 256.0));
  EXPECT_EQ(vertices.Find("id")->type, PlyType::kInt32);
  EXPECT_THAT(vertices.Find("birth_frame")->values, ElementsAre(0.0, 65535.0));
  EXPECT_THAT(vertices.Find("bx")->values, ElementsAre(1e-20f, 9.0f));
  EXPECT_THAT(vertices.Find("by")->values, ElementsAre(3.0, 10.0));
  EXPECT_THAT(vertices.Find("bz")->values, ElementsAre(-4.0, 11.0));
  EXPECT_THAT(vertices.Find("stability")->values, ElementsAre(0.75, 1.0));
  EXPECT_THAT(vertices.Find("last_seen")->values, ElementsAre(12.0, 65536.0));
}

TEST(LiveCloud, IsASnapshotForWhoReadsIt) {
  const TemporaryDirectory dir;
  std::vector<LivePoint> points(2);
  points[0] = {{1.5f, -2.25f, 0.5f}, 3, 0, {1.0f, 3.0f, -4.0f}};
  points[1] = {{0.0f, 7.0f, 8.0f}, 256, 65535, {9.0f, 10.0f, 11.0f}};
  ASSERT_TRUE(WriteLiveCloud(dir / "000012.ply", points).ok());
  std::vector<std::string> warnings;
  const StatusOr<LiveSnapshot> snapshot = ReadLiveCloud(dir / "000012.ply", 12, &warnings);
  ASSERT_TRUE(snapshot.ok()) << snapshot.status().message();
  EXPECT_EQ(snapshot->frame, 12);
  ASSERT_EQ(snapshot->size(), 2u);
  EXPECT_EQ(snapshot->points[0], Eigen::Vector3d(1.5, -2.25, 0.5));
  EXPECT_THAT(snapshot->ids, ElementsAre(3, 256));
  EXPECT_THAT(snapshot->birth_frames, ElementsAre(0, 65535));
  EXPECT_EQ(snapshot->birth_points[1], Eigen::Vector3d(9.0, 10.0, 11.0));
  EXPECT_TRUE(warnings.empty());
}

TEST(LiveCloud, IsNamedByItsFrame) {
  const TemporaryDirectory dir;
  EXPECT_EQ(LiveCloudName(12), "000012.ply");
  EXPECT_EQ(LiveCloudName(1234567), "1234567.ply");
  EXPECT_TRUE(IsLiveCloudName(LiveCloudName(1234567)));
  EXPECT_FALSE(IsLiveCloudName("12.ply"));
  for (const char* name : {"000012.ply", "000003.ply", "other.ply", "000004.txt"}) {
    WriteBytes(dir / name, "");
  }
  const auto clouds = ListLiveClouds(dir.path());
  ASSERT_TRUE(clouds.ok());
  EXPECT_THAT(
      *clouds,
      ElementsAre(::testing::Pair(3, dir / "000003.ply"), ::testing::Pair(12, dir / "000012.ply")));
  EXPECT_TRUE(ListLiveClouds(dir / "missing")->empty());
}

TEST(LiveCloud, OfNoPointsIsWholeToo) {
  const TemporaryDirectory dir;
  ASSERT_TRUE(WriteLiveCloud(dir / "live.ply", {}).ok());
  const std::string bytes = ReadBytes(dir / "live.ply");
  EXPECT_NE(bytes.find("element vertex 0\n"), std::string::npos);
  EXPECT_EQ(bytes.substr(bytes.size() - 11), "end_header\n");
}

}  // namespace
}  // namespace ceres_ed
