// map.ply, trajectory.txt and tracks.csv.
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/io/results/covariance_files.h>
#include <ceres_ed/io/results/map_ply.h>
#include <ceres_ed/io/results/tracks_csv.h>
#include <ceres_ed/io/results/trajectory_txt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(MapPly, HasAllThatIsKnownOfAPoint) {
  const TemporaryDirectory dir;
  MapSnapshot map;
  map.points = {{1, 2, 3}, {4, 5, 6}};
  map.normals = {{0, 0, 1}, {1, 0, 0}};
  map.colors = {{10, 20, 30}, {40, 50, 60}};
  map.ids = {3, 2147483647};
  map.birth_frames = {0, 12};
  map.weights = {1.0, 2.5};
  map.stabilities = {0.25, 1.0};
  map.last_seen = {4, 9};
  ASSERT_TRUE(WriteMapCloud(dir / "map.ply", map).ok());
  const StatusOr<LoadedCloud> loaded = LoadCloud(dir / "map.ply");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_EQ(loaded->cloud.points, map.points);
  EXPECT_EQ(loaded->cloud.normals, map.normals);
  const PlyElement& vertices = *loaded->document.Find("vertex");
  EXPECT_EQ(vertices.Find("green")->values[1], 50.0);
  EXPECT_EQ(vertices.Find("id")->values[1], 2147483647.0);
  EXPECT_EQ(vertices.Find("birth_frame")->values[1], 12.0);
  EXPECT_EQ(vertices.Find("weight")->values[1], 2.5);
  EXPECT_EQ(vertices.Find("stability")->values[0], 0.25);
  EXPECT_EQ(vertices.Find("last_seen")->values[1], 9.0);
}

class TrajectoryFile : public ::testing::Test {
 protected:
  TrajectoryFile() {
    pose_.translation = {0.1, 1.0 / 3.0, -2e-7};
    WriteBytes(dir_ / "trajectory.txt",
               TrajectoryHeader() + TrajectoryRow(1305031102.175304, pose_) +
                   TrajectoryRow(1305031102.211214, pose_));
  }

  StatusOr<std::map<int, CameraPose>> Read(const std::map<double, int>& frame_at) {
    return ReadTrajectoryByFrame(dir_ / "trajectory.txt", frame_at, &warnings_);
  }

  TemporaryDirectory dir_;
  CameraPose pose_;
  std::vector<std::string> warnings_;
};

TEST_F(TrajectoryFile, ReadsBackByFrame) {
  const auto poses = Read({{1305031102.175304, 4}, {1305031102.211214, 5}, {1305031102.3, 6}});
  ASSERT_TRUE(poses.ok()) << poses.status().message();
  ASSERT_EQ(poses->size(), 2u);
  EXPECT_EQ(poses->at(4).translation, pose_.translation);
  EXPECT_EQ(poses->at(5).rotation.coeffs(), pose_.rotation.coeffs());
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(TrajectoryFile, OfAnotherSequenceIsLeftOutWithAWarning) {
  const auto poses = Read({{0.0, 0}, {1.0, 1}});
  ASSERT_TRUE(poses.ok());
  EXPECT_THAT(*poses, IsEmpty());
  EXPECT_THAT(warnings_, ElementsAre(HasSubstr("trajectory.txt: time 1305031102.175304")));
}

TEST(CameraCovariance, HasTheUpperTriangleByRows) {
  const std::string header = CameraCovarianceHeader();
  EXPECT_EQ(header.substr(0, 26), "frame,tx_tx,tx_ty,tx_tz,tx");
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), 21);
  Eigen::Matrix<double, 6, 6> covariance;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) covariance(i, j) = 10 * i + j;
  }
  EXPECT_EQ(CameraCovarianceRow(7, covariance),
            "7,0,1,2,3,4,5,11,12,13,14,15,22,23,24,25,33,34,35,44,45,55\n");
}

TEST(MapCovariance, HasTheEntriesAndTheRootOfTheTrace) {
  const TemporaryDirectory dir;
  MapCovariances map;
  map.ids = {3, 8};
  map.points = {{1, 2, 3}, {4, 5, 6}};
  Eigen::Matrix3d covariance;
  covariance << 1, 0.5, 0.25, 0.5, 3, 0.125, 0.25, 0.125, 5;
  map.covariances = {covariance, Eigen::Matrix3d::Constant(std::nan(""))};
  ASSERT_TRUE(WriteMapCovariances(dir / "map.ply", map).ok());
  const StatusOr<LoadedCloud> loaded = LoadCloud(dir / "map.ply");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  EXPECT_EQ(loaded->cloud.points, map.points);
  const PlyElement& vertices = *loaded->document.Find("vertex");
  EXPECT_THAT(vertices.Find("id")->values, ElementsAre(3, 8));
  EXPECT_THAT(vertices.Find("xx")->values, ElementsAre(1, -1));
  EXPECT_THAT(vertices.Find("xz")->values, ElementsAre(0.25, -1));
  EXPECT_THAT(vertices.Find("yz")->values, ElementsAre(0.125, -1));
  EXPECT_THAT(vertices.Find("std_dev")->values, ElementsAre(3, -1));
}

TEST(TracksCsv, HasCommasAndAFlag) {
  EXPECT_EQ(TracksHeader(), "frame,id,x,y,z,visible\n");
  EXPECT_EQ(TracksRow(3, 17, {0.25, -1.0, 100000.0}, true), "3,17,0.25,-1,100000,1\n");
  EXPECT_EQ(TracksRow(0, 0, {0.0, 0.0, 0.1}, false), "0,0,0,0,0.1,0\n");
}

}  // namespace
}  // namespace ceres_ed
