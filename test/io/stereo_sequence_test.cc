#include "ceres_ed/io/sequence/layouts/stereo_file.h"
#include "ceres_ed/io/sequence/picture_reader.h"
#include "sequence_test_util.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kStereo[] =
    "# fx fy cx_left cx_right cy width height baseline_metres\n"
    "5 6 1.5 1.25 1 4 3 0.005\n";

class StereoSequence : public ::testing::Test {
 protected:
  // Writes `count` pairs whose left pictures are redder than the right ones.
  void Make(int count) {
    folder_.Text("stereo.txt", kStereo);
    for (int k = 0; k < count; ++k) {
      folder_.Color("left/" + std::to_string(k) + ".png", 200);
      folder_.Color("right/" + std::to_string(k) + ".png", 100);
    }
  }
  std::unique_ptr<DepthSequence> Open(const SequenceOptions& options = {}) {
    auto sequence = OpenSequence(folder_.path(), options);
    EXPECT_TRUE(sequence.ok()) << sequence.status().message();
    return sequence.ok() ? *std::move(sequence) : nullptr;
  }

  SequenceFolder folder_;
};

TEST_F(StereoSequence, LoadsThePicturesOfBothCameras) {
  Make(2);
  folder_.Color("mask/1.png", 255);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  ASSERT_NE(sequence->rig(), nullptr);
  EXPECT_TRUE(sequence->is_rectified());
  EXPECT_EQ(sequence->rig()->right.pinhole.cx, 1.25);
  EXPECT_EQ(sequence->rig()->right_from_left.translation, Eigen::Vector3d(-0.005, 0.0, 0.0));
  EXPECT_THAT(sequence->description(),
              HasSubstr("native_stereo (guessed: there is stereo.txt), 2 frames: 0 to 1, 4 x 3 "
                        "pixels, stereo with a baseline of 5 mm, rectified, colour"));
  const StatusOr<DepthFrame> frame = sequence->Load(1);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_TRUE(frame->depth.empty());
  EXPECT_EQ(frame->color(0, 0)[0], 200);
  EXPECT_EQ(frame->right(0, 0)[0], 100);
  EXPECT_FALSE(frame->mask.empty());
}

TEST_F(StereoSequence, PictureWithoutPartnerIsLeftOut) {
  Make(2);
  folder_.Color("left/2.png");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(0, 1));
  EXPECT_THAT(Warnings(folder_, *sequence),
              ElementsAre("DIR/left: 1 left or right pictures have no partner of the same number; "
                          "they are left out"));
}

TEST_F(StereoSequence, MeasuredDepthIsTakenUnlessStereoIsAskedFor) {
  Make(1);
  folder_.Text("camera.txt", kNativeCamera);
  folder_.Depth("depth/0.png", 1234);
  const auto with_depth = Open();
  ASSERT_NE(with_depth, nullptr);
  EXPECT_EQ(with_depth->rig(), nullptr);
  EXPECT_EQ(with_depth->Load(0)->depth(0, 0), 0.1234F);
  EXPECT_EQ(with_depth->Load(0)->color(0, 0)[0], 200);
  SequenceOptions options;
  options.depth_from = DepthFrom::kStereo;
  const auto stereo = Open(options);
  ASSERT_NE(stereo, nullptr);
  EXPECT_NE(stereo->rig(), nullptr);
}

TEST_F(StereoSequence, WithoutDepthImagesCannotTakeThem) {
  Make(1);
  SequenceOptions options;
  options.depth_from = DepthFrom::kImages;
  EXPECT_EQ(OpenError(folder_, options),
            "DIR: depth_from is images, expected stereo: the sequence has no images of depth");
}

TEST_F(StereoSequence, PictureOfAnotherSizeSaysHowToScaleTheCalibration) {
  Make(1);
  folder_.Color("right/0.png", 100, 8, 6);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  FrameProblem problem = FrameProblem::kNone;
  const StatusOr<DepthFrame> frame = sequence->Load(0, &problem);
  EXPECT_EQ(problem, FrameProblem::kWrongSize);
  EXPECT_THAT(frame.status().message(),
              HasSubstr("right/0.png: 8 x 6 pixels, expected 4 x 3 pixels as the camera has; if "
                        "they were resized, multiply fx, fy, cx and cy of the calibration by 2"));
}

TEST(StereoFile, IsReadBackAsItWasWritten) {
  const TemporaryDirectory directory;
  const StereoRig rig = MakeRectifiedRig({516.741, 517.5, 320.0, 256.0, 640, 512}, 319.813, 0.0047);
  ASSERT_TRUE(WriteStereoFile(directory / "stereo.txt", rig).ok());
  const StatusOr<StereoRig> read = ReadStereoFile(directory / "stereo.txt");
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->left.pinhole.fy, 517.5);
  EXPECT_EQ(read->right.pinhole.cx, 319.813);
  EXPECT_EQ(read->right.pinhole.height, 512);
  EXPECT_EQ(read->right_from_left.translation.x(), -0.0047);
}

TEST(StereoFile, BaselineInMillimetresIsRefused) {
  const TemporaryDirectory directory;
  WriteBytes(directory / "stereo.txt", "500 500 320 320 240 640 480 4.7\n");
  EXPECT_EQ(ReadStereoFile(directory / "stereo.txt").status().message(),
            directory / "stereo.txt" +
                ": line 1: baseline_metres is '4.7', expected metres, > 0 and at most 1 (0.005 is "
                "5 mm)");
}

TEST(PictureReader, CutsOutThePictureOfOneCamera) {
  const TemporaryDirectory directory;
  ColorImage picture(4, 2);
  for (int v = 0; v < 2; ++v) {
    for (int u = 0; u < 4; ++u) picture(u, v) = {static_cast<std::uint8_t>(10 * v + u), 0, 0};
  }
  PictureSource source;
  source.path = directory / "both.png";
  ASSERT_TRUE(WriteColorImage(source.path, picture).ok());
  const auto red = [&source](PicturePart part) {
    source.part = part;
    const StatusOr<ColorImage> cut = ReadColor(source);
    std::vector<int> values;
    for (const auto& pixel : cut->pixels()) values.push_back(pixel[0]);
    return values;
  };
  EXPECT_THAT(red(PicturePart::kTop), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(red(PicturePart::kBottom), ElementsAre(10, 11, 12, 13));
  EXPECT_THAT(red(PicturePart::kLeft), ElementsAre(0, 1, 10, 11));
  EXPECT_THAT(red(PicturePart::kRight), ElementsAre(2, 3, 12, 13));
  EXPECT_THAT(red(PicturePart::kEvenRows), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(red(PicturePart::kOddRows), ElementsAre(10, 11, 12, 13));
}

}  // namespace
}  // namespace ceres_ed
