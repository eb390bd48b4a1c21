#include "ceres_ed/stereo/depth_source.h"

#include "stereo_scenes.h"

#include <ceres_ed/io/camera_io.h>
#include <ceres_ed/io/image_io.h>
#include <ceres_ed/io/text_rows.h>
#include <ceres_ed/util/statistics.h>

#include <filesystem>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/io/io_test_util.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<TexturedPlane> kPlanes = {{Eigen::Vector3d(0.2, 0.1, 1.0).normalized(), 0.055}};

class StereoFolder : public ::testing::Test {
 protected:
  std::string path() const { return directory_.path(); }

  void WritePictures(const StereoRig& rig, bool swapped = false) {
    for (const char* side : {"left", "right"})
      std::filesystem::create_directories(directory_ / side);
    const ColorImage left = Photograph(kPlanes, rig.left.pinhole, {});
    const ColorImage right = Photograph(kPlanes, rig.right.pinhole, rig.right_from_left);
    EXPECT_TRUE(WriteColorImage(directory_ / "left/000007.png", swapped ? right : left).ok());
    EXPECT_TRUE(WriteColorImage(directory_ / "right/000007.png", swapped ? left : right).ok());
  }

  // Writes the calibration of cameras that are not rectified; the transform is in `name`.
  void WriteCalibration(const StereoRig& rig, const std::string& name, const RigidTransform& t) {
    for (const auto& [side, camera] :
         {std::pair("left", rig.left.pinhole), std::pair("right", rig.right.pinhole)}) {
      std::string text;
      AppendNumbers({camera.fx, 0.0, camera.cx}, &text);
      text += "\n";
      AppendNumbers({0.0, camera.fy, camera.cy}, &text);
      WriteBytes(directory_ / ("calib." + std::string(side) + ".intrinsic.txt"),
                 text + "\n0 0 1\n");
    }
    const Eigen::Matrix3d r = t.rotation.toRotationMatrix();
    std::string text;
    for (int i = 0; i < 3; ++i) {
      AppendNumbers({r(i, 0), r(i, 1), r(i, 2), 1e3 * t.translation[i]}, &text);
      text += "\n";
    }
    WriteBytes(directory_ / name, text + "0 0 0 1\n");
  }

  // Returns the error of opening the folder, with its path replaced by DIR.
  std::string Error(const StereoOptions& options = {}) const {
    const auto source = OpenDepthSource(path(), {}, options);
    if (source.ok()) return "no error";
    std::string message = source.status().message();
    for (std::size_t at; (at = message.find(path())) != std::string::npos;) {
      message.replace(at, path().size(), "DIR");
    }
    return message;
  }

  TemporaryDirectory directory_;
};

TEST_F(StereoFolder, GivesFramesWithDepthAndItsNoise) {
  WritePictures(RectifiedTestRig());
  ASSERT_TRUE(WriteStereoFile(directory_ / "stereo.txt", RectifiedTestRig()).ok());
  const auto source = OpenDepthSource(path(), {}, {});
  ASSERT_TRUE(source.ok()) << source.status().message();
  EXPECT_TRUE((*source)->is_stereo());
  EXPECT_THAT((*source)->warnings(), IsEmpty());
  const StatusOr<DepthFrame> frame = (*source)->Load(0);
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(frame->number, 7);
  EXPECT_GT(frame->valid_share, 0.85);
  EXPECT_GE(frame->stereo_s, 0.0);
  EXPECT_TRUE(frame->noise.known());
  EXPECT_TRUE(frame->right.empty());
  EXPECT_EQ(frame->color.width(), 320);
}

TEST_F(StereoFolder, SwappedPicturesAreNamed) {
  WritePictures(RectifiedTestRig(), /*swapped=*/true);
  ASSERT_TRUE(WriteStereoFile(directory_ / "stereo.txt", RectifiedTestRig()).ok());
  EXPECT_THAT(Error(), HasSubstr("DIR: frame 7: left and right are swapped: 100 % of the corners"));
  EXPECT_THAT(Error(), HasSubstr("expected the pictures of the left camera as left"));
  StereoOptions options;
  options.check = false;
  const auto source = OpenDepthSource(path(), {}, options);
  ASSERT_TRUE(source.ok());
  EXPECT_THAT((*source)->warnings(), ElementsAre(HasSubstr("left and right are swapped")));
}

TEST_F(StereoFolder, PicturesThatAreNotRectifiedAreNamed) {
  WritePictures(TurnedTestRig());
  ASSERT_TRUE(WriteStereoFile(directory_ / "stereo.txt", RectifiedTestRig()).ok());
  EXPECT_THAT(Error(),
              HasSubstr("DIR: frame 7: the rows of the left and the right picture do not "
                        "correspond: they differ by "));
  EXPECT_THAT(Error(),
              HasSubstr("expected rectified pictures, or the calibration of both cameras"));
}

TEST_F(StereoFolder, MissingTransformIsNamed) {
  WritePictures(TurnedTestRig());
  WriteCalibration(TurnedTestRig(), "calib.x.txt", {});
  EXPECT_EQ(Error(),
            "DIR/calib.l2r.txt: not there, expected it or calib.r2l.txt: the transform between the "
            "cameras, 4 x 4 numbers, millimetres");
}

TEST_F(StereoFolder, MissingCalibrationIsNamed) {
  WritePictures(RectifiedTestRig());
  EXPECT_THAT(Error(), HasSubstr("stereo.txt, left/NNNNNN.png and right/NNNNNN.png"));
}

TEST_F(StereoFolder, TransformsAreReadInBothDirections) {
  const StereoRig rig = TurnedTestRig();
  WritePictures(rig);
  WriteCalibration(rig, "calib.r2l.txt", rig.right_from_left.Inverse());
  EXPECT_EQ(Error(), "no error");
  WriteCalibration(rig, "calib.l2r.txt", rig.right_from_left);
  EXPECT_EQ(Error(), "no error");
  std::filesystem::remove(directory_ / "calib.r2l.txt");
  WriteCalibration(rig, "calib.l2r.txt", rig.right_from_left.Inverse());
  EXPECT_THAT(Error(), HasSubstr("it is the wrong way round, expected the name calib.r2l.txt"));
}

TEST_F(StereoFolder, CalibrationOfAnotherSizeIsNamed) {
  StereoRig rig = TurnedTestRig();
  WritePictures(rig);
  for (PinholeCamera* camera : {&rig.left.pinhole, &rig.right.pinhole}) {
    camera->cx *= 3.0;
    camera->cy *= 3.0;
  }
  WriteCalibration(rig, "calib.l2r.txt", rig.right_from_left);
  EXPECT_THAT(Error(),
              HasSubstr("left/000007.png: 320 x 240 pixels, and the calibration has its "
                        "principal point at (480, 359)"));
}

// The given pose is that of the left camera as it is; depth is in the rectified one.
TEST_F(StereoFolder, PosesAreThoseOfTheRectifiedCamera) {
  const StereoRig rig = TurnedTestRig();
  WritePictures(rig);
  WriteCalibration(rig, "calib.l2r.txt", rig.right_from_left);
  ASSERT_TRUE(WritePosesFile(directory_ / "poses.txt", {{7, CameraPose()}}).ok());
  const auto source = OpenDepthSource(path(), {}, {});
  ASSERT_TRUE(source.ok()) << source.status().message();
  ASSERT_NE((*source)->given_pose(0), nullptr);
  const StatusOr<DepthFrame> frame = (*source)->Load(0);
  ASSERT_TRUE(frame.ok());
  std::vector<double> distances;
  for (int v = 20; v < 220; v += 10) {
    for (int u = 100; u < 300; u += 10) {
      if (frame->depth(u, v) == 0.0F) continue;
      const Eigen::Vector3d point =
          *(*source)->given_pose(0) *
          (*source)->camera().BackProject(u, v, static_cast<double>(frame->depth(u, v)));
      distances.push_back(kPlanes[0].normal.dot(point) - kPlanes[0].distance);
    }
  }
  EXPECT_GT(distances.size(), 200u);
  EXPECT_LT(RobustDeviation(distances), 3e-4);
}

}  // namespace
}  // namespace ceres_ed
