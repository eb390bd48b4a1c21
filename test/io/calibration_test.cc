#include "ceres_ed/io/calibration/llff_poses.h"
#include "ceres_ed/io/calibration/stereo_calibration.h"
#include "ceres_ed/io/npy_file.h"
#include "io_test_util.h"

#include <ceres_ed/io/calibration/camera_matrix.h>

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kOpenCv[] =
    "%YAML:1.0\n---\n"
    "M1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 1035.3, 0., 596.9, 0., 1035.1, 520.4,\n       0., 0., 1. ]\n"
    "D1: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ -1e-3, 2e-3, 0., 0., 3e-3 "
    "]\n"
    "M2: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 1035.2, 0., 688.4, 0., 1034.9, 521., 0., 0., 1. ]\n"
    "D2: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n   data: [ 0., 0., 0., 0., 0. ]\n"
    "R: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 1., 0., 0., 0., 0.6, -0.8, 0., 0.8, 0.6 ]\n";

std::string OpenCvT(const std::string& numbers) {
  return std::string(kOpenCv) +
         "T: !!opencv-matrix\n   rows: 3\n   cols: 1\n   dt: d\n   data: [ " + numbers + " ]\n";
}

class CalibrationFiles : public ::testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    WriteBytes(folder_ / name, text);
    return folder_ / name;
  }
  // Returns the error or the remarks with the folder replaced by DIR.
  std::string Short(std::string text) const {
    const std::size_t at = text.find(folder_.path());
    return at == std::string::npos ? text : text.replace(at, folder_.path().size(), "DIR");
  }

  TemporaryDirectory folder_;
};

TEST_F(CalibrationFiles, OpenCvMillimetresAreBroughtToMetres) {
  const auto calibration =
      ReadOpenCvCalibration(Write("calibration.yaml", OpenCvT("-4.125, 0.5, 0.")));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  const StereoRig& rig = calibration->rig;
  EXPECT_EQ(rig.left.pinhole.fx, 1035.3);
  EXPECT_EQ(rig.left.pinhole.cy, 520.4);
  EXPECT_EQ(rig.left.pinhole.width, 0);
  EXPECT_EQ(rig.left.distortion[4], 3e-3);
  EXPECT_EQ(rig.left.distortion[5], 0.0);
  EXPECT_EQ(rig.right.pinhole.cx, 688.4);
  EXPECT_NEAR(rig.right_from_left.translation.x(), -0.004125, 1e-15);
  // The second axis of the left camera, seen from the right one.
  EXPECT_NEAR(
      (rig.right_from_left.rotation * Eigen::Vector3d::UnitY() - Eigen::Vector3d(0, .6, .8)).norm(),
      0.0,
      1e-12);
  EXPECT_FALSE(calibration->is_rectified);
  ASSERT_EQ(calibration->remarks.size(), 1U);
  EXPECT_EQ(Short(calibration->remarks[0]),
            "DIR/calibration.yaml: the baseline of 4.155 is taken as millimetres");
}

TEST_F(CalibrationFiles, SmallTranslationsAreMetres) {
  const auto calibration = ReadOpenCvCalibration(Write("c.yaml", OpenCvT("-0.0045, 0, 0")));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_EQ(calibration->rig.right_from_left.translation.x(), -0.0045);
  EXPECT_THAT(calibration->remarks, ElementsAre(HasSubstr("0.0045 is taken as metres")));
}

TEST_F(CalibrationFiles, TransformsFromRightToLeftAreInvertedAndNamed) {
  const auto calibration = ReadOpenCvCalibration(Write("c.yaml", OpenCvT("4.0, 0, 0")));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_NEAR(calibration->rig.right_from_left.translation.x(), -0.004, 1e-15);
  EXPECT_THAT(calibration->remarks[1], HasSubstr("taken as the transform from right to left"));
}

TEST_F(CalibrationFiles, BadOpenCvFilesAreErrors) {
  const auto error = [this](const std::string& text) {
    const auto calibration = ReadOpenCvCalibration(Write("c.yaml", text));
    return calibration.ok() ? "no error" : Short(calibration.status().message());
  };
  EXPECT_EQ(error(kOpenCv), "DIR/c.yaml: no T, expected it in a calibration of this kind");
  EXPECT_EQ(error(OpenCvT("1, 2")), "DIR/c.yaml: T has 2 numbers, expected 3 x 1");
  EXPECT_EQ(error(OpenCvT("1, .Nan, 2")),
            "DIR/c.yaml: T is '[1.0,\".Nan\",2.0]', expected finite numbers");
  EXPECT_THAT(error(OpenCvT("0, 0, 0")), HasSubstr("is 0, expected the baseline"));
  std::string mirrored = OpenCvT("-4, 0, 0");
  mirrored.replace(mirrored.find("0.6, -0.8"), 9, "0.6, +0.8");
  EXPECT_THAT(error(mirrored), HasSubstr("is no rotation"));
  EXPECT_THAT(error("a: [1, 2\nb: : 3\n"), HasSubstr("DIR/c.yaml: line "));
  EXPECT_THAT(error(""), HasSubstr("no M1"));
}

TEST_F(CalibrationFiles, IniOfStereoMisIsRead) {
  std::string text = "[StereoLeft]\nres_x=1280\nres_y = 1024\nfc_x=1000\nfc_y=1001\ncc_x=600\n";
  text += "cc_y=500\n";
  for (int i = 0; i < 8; ++i) text += "kc_" + std::to_string(i) + "=0.0" + std::to_string(i) + "\n";
  std::string right = text;
  right.replace(1, 10, "StereoRight");
  right.replace(right.find("cc_x=600"), 8, "cc_x=650");
  text += right + "R_0=1\nR_1=0\nR_2=0\nR_3=0\nR_4=1\nR_5=0\nR_6=0\nR_7=0\nR_8=1\n";
  const std::string translation = "T_0=-4.2\nT_1=0\nT_2=0\n";
  const auto calibration = ReadIniCalibration(Write("s.ini", text + translation));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_EQ(calibration->rig.left.pinhole.width, 1280);
  EXPECT_EQ(calibration->rig.left.pinhole.fy, 1001.0);
  EXPECT_EQ(calibration->rig.right.pinhole.cx, 650.0);
  EXPECT_EQ(calibration->rig.right.distortion[7], 0.07);
  EXPECT_NEAR(calibration->rig.right_from_left.translation.x(), -0.0042, 1e-15);
  EXPECT_EQ(Short(ReadIniCalibration(Write("s.ini", text)).status().message()),
            "DIR/s.ini: no StereoRight.T_0, expected it in a calibration of this kind");
}

TEST_F(CalibrationFiles, CamcalTurnsByTheRotationVector) {
  const auto calibration =
      ReadCamcalCalibration(Write("camcal.json",
                                  R"({"data": {"width": 640, "height": 512, "intrinsics": [
            {"f": [500, 501], "c": [320, 250], "k": [0.1, 0, 0, 0, 0]},
            {"f": [502, 503], "c": [330, 251], "k": [0, 0, 0, 0, 0]}],
          "extrinsics": {"om": [0, 0, 1.5707963267948966], "T": [-0.005, 0, 0]}}})"));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_EQ(calibration->rig.right.pinhole.fy, 503.0);
  const Eigen::Vector3d turned =
      calibration->rig.right_from_left.rotation * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(turned.y(), 1.0, 1e-12);
}

TEST_F(CalibrationFiles, StirIsRead) {
  const auto calibration =
      ReadStirCalibration(Write("calib.json",
                                R"({"leftcameramat": [[1000, 0, 600], [0, 1000, 500], [0, 0, 1]],
          "rightcameramat": [[1000, 0, 680], [0, 1000, 500], [0, 0, 1]],
          "leftdistortioncoeffs": [0, 0, 0, 0, 0], "rightdistortioncoeffs": [[0, 0, 0, 0, 0]],
          "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "translation": [-0.0043, 0, 0]})"));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_EQ(calibration->rig.right.pinhole.cx, 680.0);
  EXPECT_EQ(calibration->rig.right_from_left.translation.x(), -0.0043);
}

TEST_F(CalibrationFiles, RosBaselineIsThatOfTheRightProjection) {
  const std::string left =
      "image_width: 640\nimage_height: 480\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, "
      "0, "
      "0, 1, 0, 0, 0, 1]\nprojection_matrix:\n  rows: 3\n  cols: 4\n  data: [500, 0, 320, 0, 0, "
      "500, "
      "240, 0, 0, 0, 1, 0]\n";
  const std::string right =
      "width: 640\nheight: 480\nP:\n- 500.0\n- 0.0\n- 325.0\n- -2.5\n- 0.0\n- 500.0\n- 240.0\n- "
      "0.0\n"
      "- 0.0\n- 0.0\n- 1.0\n- 0.0\n";
  const auto calibration = ReadRosCalibration(Write("l.yaml", left), Write("r.yaml", right));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_TRUE(calibration->is_rectified);
  EXPECT_EQ(calibration->rig.left.pinhole.height, 480);
  EXPECT_EQ(calibration->rig.right.pinhole.cx, 325.0);
  EXPECT_NEAR(calibration->rig.right_from_left.translation.x(), -0.005, 1e-15);
}

TEST_F(CalibrationFiles, ServCtIsInMillimetres) {
  const auto calibration =
      ReadServCtCalibration(Write("001.json",
                                  R"({"P1": [[700, 0, 300, 0], [0, 700, 280, 0], [0, 0, 1, 0]],
          "P2": [[700, 0, 310, -3500], [0, 700, 280, 0], [0, 0, 1, 0]]})"));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_NEAR(calibration->rig.right_from_left.translation.x(), -0.005, 1e-15);
  EXPECT_EQ(calibration->rig.right.pinhole.cx, 310.0);
}

TEST_F(CalibrationFiles, SlamSettingsGiveTheBaselineTimesFocalLength) {
  const std::string camera = "%YAML:1.0\n\nCamera.fx: 766.38\nCamera.fy: 766.38\nCamera.cx: 300\n";
  const auto calibration =
      ReadSlamSettings(Write("settings.yaml", camera + "Camera.cy: 100\nCamera.bf: 3886.37\n"));
  ASSERT_TRUE(calibration.ok()) << calibration.status().message();
  EXPECT_NEAR(calibration->rig.right_from_left.translation.x(), -3.88637 / 766.38, 1e-12);
  EXPECT_TRUE(calibration->is_rectified);
  EXPECT_EQ(Short(ReadSlamSettings(Write("s.yaml", camera)).status().message()),
            "DIR/s.yaml: no Camera.cy, expected it in a calibration of this kind");
}

class LlffPoses : public CalibrationFiles {
 protected:
  StatusOr<LlffCamera> Read(double first, double second, double focal) {
    NpyArray array;
    array.shape = {2, 17};
    array.values.assign(34, 0.0);
    array.values[4] = first;
    array.values[9] = second;
    array.values[14] = focal;
    EXPECT_TRUE(WriteNpyFile(folder_ / "poses_bounds.npy", array).ok());
    return ReadLlffCamera(folder_ / "poses_bounds.npy", 640, 512);
  }
};

TEST_F(LlffPoses, HeightWidthAndFocalLengthAreRead) {
  const auto camera = Read(512, 640, 569.5);
  ASSERT_TRUE(camera.ok()) << camera.status().message();
  EXPECT_EQ(camera->focal, 569.5);
  EXPECT_EQ(camera->num_frames, 2);
  EXPECT_FALSE(camera->has_center);
  EXPECT_THAT(camera->remarks, IsEmpty());
}

TEST_F(LlffPoses, CentreInThePlaceOfTheSizeIsFoundAndNamed) {
  const auto camera = Read(251.5, 330.25, 569.5);
  ASSERT_TRUE(camera.ok()) << camera.status().message();
  EXPECT_TRUE(camera->has_center);
  EXPECT_EQ(camera->cx, 330.25);
  EXPECT_EQ(camera->cy, 251.5);
  EXPECT_EQ(Short(camera->remarks[0]),
            "DIR/poses_bounds.npy: [251.5, 330.25, 569.5] stand where height, width and focal "
            "length belong, and the pictures have 640 x 512 pixels: taken as cy, cx and focal "
            "length");
}

TEST_F(LlffPoses, FocalLengthOfScaledPicturesIsScaled) {
  const auto camera = Read(1024, 1280, 1000);
  ASSERT_TRUE(camera.ok()) << camera.status().message();
  EXPECT_EQ(camera->focal, 500.0);
  EXPECT_THAT(camera->remarks, ElementsAre(HasSubstr("scaled by 0.5")));
}

TEST_F(LlffPoses, OtherSizesAndFocalLengthsAreErrors) {
  EXPECT_EQ(Short(Read(480, 900, 500).status().message()),
            "DIR/poses_bounds.npy: height and width are 480 and 900, expected those of the "
            "pictures, 512 and 640 (or cy and cx, about half of them)");
  EXPECT_THAT(Read(512, 640, -1).status().message(), HasSubstr("focal length"));
}

TEST_F(CalibrationFiles, CameraMatrixMayHaveFourRows) {
  const auto file =
      ReadIntrinsicsFile(Write("i.txt", "575 0 319 0\n0 576 239 0\n0 0 1 0\n0 0 0 1\n"));
  ASSERT_TRUE(file.ok()) << file.status().message();
  EXPECT_EQ(file->rows, 4);
  EXPECT_EQ(file->camera.fy, 576.0);
  EXPECT_THAT(ReadIntrinsicsFile(Write("i.txt", "575 0 319 0\n0 576 239 0\n0 0 1 0\n0 0 0 2\n"))
                  .status()
                  .message(),
              HasSubstr("the fourth row and column are not those of the identity"));
}

}  // namespace
}  // namespace ceres_ed
