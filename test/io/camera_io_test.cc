#include "ceres_ed/io/camera_io.h"

#include "io_test_util.h"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr char kCameraExpected[] = "expected 7: fx fy cx cy width height depth_units_per_metre";

class CameraFiles : public ::testing::Test {
 protected:
  std::string CameraError(const std::string& bytes) {
    WriteBytes(path_, bytes);
    return Behind(ReadCameraFile(path_).status());
  }
  std::string PosesError(const std::string& bytes) {
    WriteBytes(path_, bytes);
    return Behind(ReadPosesFile(path_).status());
  }
  std::string TrajectoryError(const std::string& bytes) {
    WriteBytes(path_, bytes);
    return Behind(ReadTrajectory(path_).status());
  }
  std::string Behind(const Status& status) const {
    return status.ok() ? "no error" : status.message().substr(path_.size() + 2);
  }

  TemporaryDirectory directory_;
  std::string path_ = directory_ / "file.txt";
};

TEST_F(CameraFiles, CameraIsSevenNumbersOnOneLineOrSeveral) {
  for (const std::string text : {"# fx fy\n560.5 561 319.5 -2e1 640 480 10000\n# end",
                                 "560.5 561\n319.5,-20 # centre\n\n640 480\n+10000"}) {
    for (const std::string& bytes : {text, WithCrLf(text)}) {
      WriteBytes(path_, bytes);
      const StatusOr<CameraFile> file = ReadCameraFile(path_);
      ASSERT_TRUE(file.ok()) << file.status().message();
      EXPECT_EQ(file->camera.fx, 560.5);
      EXPECT_EQ(file->camera.fy, 561.0);
      EXPECT_EQ(file->camera.cx, 319.5);
      EXPECT_EQ(file->camera.cy, -20.0);
      EXPECT_EQ(file->camera.width, 640);
      EXPECT_EQ(file->camera.height, 480);
      EXPECT_EQ(file->depth_units_per_metre, 10000.0);
    }
  }
}

TEST_F(CameraFiles, CameraErrorsNameLineValueAndExpectation) {
  EXPECT_EQ(CameraError("# c\n0 1 2 3 4 5 6"),
            "line 2: fx is '0', expected a focal length > 0 pixels");
  EXPECT_EQ(CameraError("1 -1 2 3 4 5 6"),
            "line 1: fy is '-1', expected a focal length > 0 pixels");
  EXPECT_EQ(CameraError("1 1 nan 3 4 5 6"), "line 1: cx is 'nan', expected a finite number");
  EXPECT_EQ(CameraError("1 1 2 1e999 4 5 6"), "line 1: cy is '1e999', expected a finite number");
  EXPECT_EQ(CameraError("1 1 2 3\n4.5 5 6"),
            "line 2: width is '4.5', expected a whole number of pixels from 1 to 32768");
  EXPECT_EQ(CameraError("1 1 2 3 4 0 6"),
            "line 1: height is '0', expected a whole number of pixels from 1 to 32768");
  EXPECT_EQ(CameraError("1 1 2 3 4 32769 6"),
            "line 1: height is '32769', expected a whole number of pixels from 1 to 32768");
  EXPECT_EQ(CameraError("1 1 2 3 4 5 0"),
            "line 1: depth_units_per_metre is '0', expected a number > 0 (1000: millimetres)");
  EXPECT_EQ(CameraError("1 1 2 3 4 5 mm"),
            "line 1: depth_units_per_metre is 'mm', expected a finite number");
  EXPECT_EQ(CameraError("1 1 2 3 4 5"), std::string("6 numbers, ") + kCameraExpected);
  EXPECT_EQ(CameraError("1"), std::string("1 number, ") + kCameraExpected);
  EXPECT_EQ(CameraError("# nothing"), std::string("0 numbers, ") + kCameraExpected);
  EXPECT_EQ(CameraError("1 1 2 3 4 5 6\n7"),
            "line 2: '7' behind the seventh number, expected nothing more than fx fy cx cy width "
            "height depth_units_per_metre");
  EXPECT_THAT(ReadCameraFile(directory_ / "none.txt").status().message(),
              HasSubstr("none.txt: cannot read: No such file or directory"));
}

TEST_F(CameraFiles, CameraReadsBackAsTheSameDoubles) {
  const CameraFile written = {{560.1 / 3.0, 1e-7 / 3.0, -0.1, 1.0 / 7.0, 100000 / 4, 1}, 1e5};
  ASSERT_TRUE(WriteCameraFile(path_, written).ok());
  const StatusOr<CameraFile> read = ReadCameraFile(path_);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->camera.fx, written.camera.fx);
  EXPECT_EQ(read->camera.fy, written.camera.fy);
  EXPECT_EQ(read->camera.cx, written.camera.cx);
  EXPECT_EQ(read->camera.cy, written.camera.cy);
  EXPECT_EQ(read->camera.width, 25000);
  EXPECT_EQ(read->camera.height, 1);
  EXPECT_EQ(read->depth_units_per_metre, 1e5);
  EXPECT_THAT(ReadBytes(path_), HasSubstr(" 100000\n"));
}

TEST_F(CameraFiles, CameraThatCannotBeReadIsNotWritten) {
  EXPECT_EQ(Behind(WriteCameraFile(path_, {{0.0, 1.0, 0.0, 0.0, 4, 4}, 1000.0})),
            "fx is '0', expected a focal length > 0 pixels");
  EXPECT_EQ(Behind(WriteCameraFile(path_, {{1.0, 1.0, kNaN, 0.0, 4, 4}, 1000.0})),
            "cx is 'nan', expected a finite number");
  EXPECT_EQ(directory_.NumFiles(), 0u);
}

TEST_F(CameraFiles, PosesAreReadInTheOrderOfTheFile) {
  WriteBytes(path_, "# frame ...\n7 1 2 3 0 0 0 2\n\n100000 -1 0 .5 0.6 0 0 0.8 # turned\n");
  const StatusOr<std::vector<FramePose>> poses = ReadPosesFile(path_);
  ASSERT_TRUE(poses.ok()) << poses.status().message();
  ASSERT_EQ(poses->size(), 2u);
  EXPECT_EQ((*poses)[0].frame, 7);
  EXPECT_EQ((*poses)[0].world_from_camera.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ((*poses)[0].world_from_camera.rotation.coeffs(), Eigen::Vector4d(0, 0, 0, 1));
  EXPECT_EQ((*poses)[1].frame, 100000);
  EXPECT_EQ((*poses)[1].world_from_camera.translation, Eigen::Vector3d(-1, 0, 0.5));
  // The sine of half the angle about x is 0.6, so y is turned to (0, 1 - 2 0.36, 2 0.6 0.8).
  const Eigen::Vector3d turned = (*poses)[1].world_from_camera.rotation * Eigen::Vector3d(0, 1, 0);
  EXPECT_NEAR((turned - Eigen::Vector3d(0, 0.28, 0.96)).norm(), 0.0, 1e-15);
}

TEST_F(CameraFiles, QuaternionsComeBackWithUnitLength) {
  WriteBytes(path_,
             "0 0 0 0 1e200 1e200 -1e200 1e200\n1 0 0 0 1e-300 0 0 0\n2 0 0 0 .1 .2 .3 .4\n");
  const StatusOr<std::vector<FramePose>> poses = ReadPosesFile(path_);
  ASSERT_TRUE(poses.ok()) << poses.status().message();
  for (const FramePose& pose : *poses) {
    EXPECT_NEAR(pose.world_from_camera.rotation.norm(), 1.0, 1e-15);
  }
  EXPECT_NEAR((*poses)[0].world_from_camera.rotation.z(), -0.5, 1e-15);
  EXPECT_EQ((*poses)[1].world_from_camera.rotation.x(), 1.0);
}

TEST_F(CameraFiles, PoseErrorsNameLineValueAndExpectation) {
  EXPECT_EQ(PosesError("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 0"),
            "line 2: the quaternion is 0 0 0 0, expected one of unit length");
  EXPECT_EQ(PosesError("0 0 0 inf 0 0 0 1"), "line 1: tz is 'inf', expected a finite number");
  EXPECT_EQ(PosesError("0 0 0 0 0 x 0 1"), "line 1: qy is 'x', expected a finite number");
  EXPECT_EQ(PosesError("0 0 0 0 0 0 1"),
            "line 1: 7 fields, expected 8: frame tx ty tz qx qy qz qw");
  EXPECT_EQ(PosesError("0 0 0 0 0 0 0 1 9"),
            "line 1: 9 fields, expected 8: frame tx ty tz qx qy qz qw");
  EXPECT_EQ(PosesError("1.5 0 0 0 0 0 0 1"),
            "line 1: frame is '1.5', expected a whole number from 0 to 2147483647");
  EXPECT_EQ(PosesError("-1 0 0 0 0 0 0 1"),
            "line 1: frame is '-1', expected a whole number from 0 to 2147483647");
  EXPECT_EQ(PosesError("3 0 0 0 0 0 0 1\n\n03 0 0 0 0 0 0 1"),
            "line 3: frame 3 is there a second time, expected one row a frame");
  EXPECT_EQ(TrajectoryError("nan 0 0 0 0 0 0 1"),
            "line 1: timestamp is 'nan', expected a finite number");
  EXPECT_EQ(TrajectoryError("0"), "line 1: 1 field, expected 8: timestamp tx ty tz qx qy qz qw");
}

TEST_F(CameraFiles, PosesReadBackAsTheSameDoubles) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<FramePose> written;
  for (const int frame : {0, 100000, 5, 2147483647}) {
    for (int repeat = 0; repeat < 100; ++repeat) {
      FramePose pose;
      pose.frame = frame - repeat + (frame < 100 ? 1000 * (frame + 1) : 0);
      pose.world_from_camera.translation = {normal(random), 1e-9 * normal(random), 1e9};
      pose.world_from_camera.rotation.coeffs() =
          Eigen::Vector4d(normal(random), normal(random), normal(random), normal(random))
              .normalized();
      written.push_back(pose);
    }
  }
  ASSERT_TRUE(WritePosesFile(path_, written).ok());
  const StatusOr<std::vector<FramePose>> read = ReadPosesFile(path_);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    const CameraPose& pose = (*read)[i].world_from_camera;
    EXPECT_EQ((*read)[i].frame, written[i].frame);
    EXPECT_EQ(pose.translation, written[i].world_from_camera.translation);
    EXPECT_EQ(pose.rotation.coeffs(), written[i].world_from_camera.rotation.coeffs());
  }
}

TEST_F(CameraFiles, TrajectoryKeepsTimesOrderAndDoubles) {
  const std::vector<TimedPose> written = {
      {1305031102.175304, {}}, {0.1, {}}, {1305031102.175304, {}}, {-1e-9, {}}};
  ASSERT_TRUE(WriteTrajectory(path_, written).ok());
  const StatusOr<std::vector<TimedPose>> read = ReadTrajectory(path_);
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ((*read)[i].time_s, written[i].time_s);
    EXPECT_EQ((*read)[i].world_from_camera.rotation.coeffs(), Eigen::Vector4d(0, 0, 0, 1));
  }
  EXPECT_THAT(ReadBytes(path_), HasSubstr("\n1305031102.175304 0 0 0 0 0 0 1\n"));
}

TEST_F(CameraFiles, PosesThatAreNoneAreNotWritten) {
  CameraPose pose;
  pose.translation.y() = kNaN;
  EXPECT_FALSE(WritePosesFile(path_, {{3, pose}}).ok());
  EXPECT_FALSE(WriteTrajectory(path_, {{0.5, pose}}).ok());
  pose = CameraPose();
  pose.rotation.coeffs().setZero();
  EXPECT_FALSE(WritePosesFile(path_, {{3, pose}}).ok());
  EXPECT_FALSE(WriteTrajectory(path_, {{kNaN, CameraPose()}}).ok());
  EXPECT_EQ(directory_.NumFiles(), 0u);
}

}  // namespace
}  // namespace ceres_ed
