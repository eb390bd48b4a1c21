#include "ceres_ed/evaluation/layout_truth.h"

#include "../io/sequence_test_util.h"
#include "ceres_ed/evaluation/scan_truth.h"
#include "ceres_ed/evaluation/sequence_figures.h"
#include "ceres_ed/evaluation/sequence_files.h"

#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/sequence/layouts/stir_truth.h>
#include <ceres_ed/io/sequence/layouts/surgt_truth.h>

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(RegionCenters, AreTheMiddlesOfBoundingBoxes) {
  MaskImage mask(20, 10, 0);
  // A square of 5 x 5, and a diagonal line that touches itself at corners only.
  for (int v = 1; v < 6; ++v) {
    for (int u = 2; u < 7; ++u) mask(u, v) = 1;
  }
  for (int i = 0; i < 4; ++i) mask(12 + i, 4 + i) = 1;
  const std::vector<Eigen::Vector2d> centers = RegionCenters(mask);
  ASSERT_EQ(centers.size(), 2U);
  EXPECT_EQ(centers[0], Eigen::Vector2d(4, 3));
  EXPECT_EQ(centers[1], Eigen::Vector2d(14, 6));
  EXPECT_THAT(RegionCenters(MaskImage(3, 3, 0)), IsEmpty());
}

TEST(EndPoints, AreComparedWithTheNearestGivenPoint) {
  const EndPointError error = CompareEndPoints(3, {{10, 10}, {50, 10}}, {{13, 14}, {50, 20}});
  EXPECT_EQ(error.points, 3);
  EXPECT_EQ(error.followed, 2);
  EXPECT_EQ(error.error->max, 10.0);
  EXPECT_THAT(error.within, ElementsAre(0.0, 0.5, 1.0, 1.0, 1.0));
  EXPECT_FALSE(CompareEndPoints(3, {}, {{1, 1}}).error.has_value());
}

TEST(Boxes, AreReadAsListsAndAsMaps) {
  SequenceFolder folder;
  folder.Text(
      "gt_rectified_0.yaml",
      "- [true, false, [[1, 2, 10, 20], [0, 2, 10, 20]]]\n- [false, false, null]\n"
      "- - true\n  - true\n  - - - 5\n      - 6\n      - 10\n      - 20\n    - [4, 6, 10, 20]\n");
  folder.Text("gt_rectified_1.yaml", "4:\n- true\n- false\n- - [1, 2, 3, 4]\n  - [0, 2, 3, 4]\n");
  const auto tracks = ReadSurgTBoxes(folder.path());
  ASSERT_TRUE(tracks.ok()) << tracks.status().message();
  ASSERT_EQ(tracks->size(), 2U);
  EXPECT_EQ((*tracks)[0].boxes.size(), 2U);
  EXPECT_EQ((*tracks)[0].boxes.at(0).left.center(), Eigen::Vector2d(6, 12));
  EXPECT_TRUE((*tracks)[0].boxes.at(2).is_difficult);
  EXPECT_EQ((*tracks)[1].boxes.at(4).right.u, 0.0);
  // What is written is read back.
  folder.Text("gt_rectified_0.yaml", BoxTrackText((*tracks)[0], 3));
  EXPECT_EQ((*ReadSurgTBoxes(folder.path()))[0].boxes.at(2).left.v, 6.0);
  folder.Text("gt_rectified_1.yaml", "- [true, false, [[1, 2], [0, 2, 3, 4]]]\n");
  EXPECT_THAT(ReadSurgTBoxes(folder.path()).status().message(),
              HasSubstr("gt_rectified_1.yaml: frame 0 is no annotation, expected [visible"));
}

TEST(PointsOfSuper, ThatAreNoNumbersAreNamed) {
  SequenceFolder folder;
  folder.Color("rgb/000000-left.png", 9, 640, 480);
  folder.Depth("depth/000000-left.png", 100, 640, 480);
  folder.Text("rgb/left_pts.npy", "pickled");
  const StatusOr<SequenceFiles> files = OpenSequenceFiles(folder.path());
  ASSERT_TRUE(files.ok()) << files.status().message();
  EXPECT_THAT(files->tracks, IsEmpty());
  EXPECT_THAT(files->warnings, Contains(HasSubstr("its points are not used")));
}

TEST(TumSequences, HaveTheirPosesAsTruth) {
  SequenceFolder folder;
  folder.Text("depth.txt", "10.00 depth/a.png\n10.10 depth/b.png\n");
  folder.Text("groundtruth.txt", "10.00 1 0 0 0 0 0 1\n10.10 2 0 0 0 0 0 1\n");
  folder.Text("camera.txt", "5 6 1.5 1 4 3 5000\n");
  folder.Depth("depth/a.png");
  folder.Depth("depth/b.png");
  const StatusOr<SequenceFiles> files = OpenSequenceFiles(folder.path());
  ASSERT_TRUE(files.ok()) << files.status().message();
  ASSERT_EQ(files->true_poses.size(), 2U);
  EXPECT_EQ(files->true_poses.at(1).translation.x(), 2.0);
}

TEST(ScansOfD4d, AreTurnedIntoTheCameraAndIntoMetres) {
  SequenceFolder session;
  session.Text("clips.json", R"({"clips": [{"name": "Clip_1", "start_geometry": "zivid/a.ply"}]})");
  // 100 mm in front of the camera, which is 300 mm above the origin and looks along z.
  session.Text("zivid/a.ply", AsciiMesh({"10 0 400", "0 20 400"}, {}));
  session.Text("clips/Clip_1/curated_camera_pose_start.txt",
               "1 0 0 0\n0 1 0 0\n0 0 1 300\n0 0 0 1\n");
  const auto scans = ReadScans(session / "clips/Clip_1", 3, 9);
  ASSERT_TRUE(scans.ok()) << scans.status().message();
  ASSERT_EQ(scans->size(), 1U);
  ASSERT_EQ(scans->at(3).size(), 2U);
  EXPECT_NEAR((scans->at(3)[0] - Eigen::Vector3d(0.01, 0, 0.1)).norm(), 0.0, 1e-12);
  EXPECT_THAT(*ReadScans(session.path(), 0, 1), IsEmpty());
}

TEST(ScansOfD4d, AreComparedWithWhatTheCameraSees) {
  const PinholeCamera camera = {100, 100, 31.5, 23.5, 64, 48};
  LiveSnapshot snapshot;
  snapshot.frame = 3;
  // The last point is behind the camera.
  snapshot.points = {{0, 0, 0.1}, {0.01, 0, 0.1}, {0, 0, -0.1}};
  snapshot.ids = {0, 1, 2};
  const ScanAgreement agreement =
      CompareWithScan(camera, snapshot, {{0, 0, 0.102}, {0.01, 0, 0.102}});
  EXPECT_EQ(agreement.frame, 3);
  EXPECT_EQ(agreement.seen, 2);
  EXPECT_NEAR(agreement.distance->mean, 0.002, 1e-12);
}

}  // namespace
}  // namespace ceres_ed
