// What goes wrong with recordings of others: each is named in a sentence, or put right.
#include "ceres_ed/io/sequence/layouts/layout_files.h"
#include "ceres_ed/io/sequence/picture_files.h"
#include "sequence_test_util.h"

#include <ceres_ed/io/npy_file.h>
#include <ceres_ed/io/sequence/sequence_writer.h>

#include <array>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Writes a mask of 10 x 10 pixels of which the first `white` ones are white.
void WriteMask(const std::string& path, int white) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  ColorImage mask(10, 10);
  for (int i = 0; i < white; ++i) mask(i % 10, i / 10) = {255, 255, 255};
  ASSERT_TRUE(WriteColorImage(path, mask).ok());
}

class Traps : public ::testing::Test {
 protected:
  std::unique_ptr<DepthSequence> Open(const SequenceOptions& options = {}) {
    StatusOr<std::unique_ptr<DepthSequence>> sequence = OpenSequence(folder_.path(), options);
    if (sequence.ok()) return std::move(*sequence);
    ADD_FAILURE() << sequence.status().message();
    return nullptr;
  }
  // A native sequence of 10 x 10 pixels with masks whose first `white` pixels are white.
  void MakeMasked(int white) {
    folder_.Text("camera.txt", "5 5 4.5 4.5 10 10 1000\n");
    folder_.Depth("depth/0.png", 100, 10, 10);
    WriteMask(folder_ / "mask/0.png", white);
  }
  int Used(const DepthSequence& sequence) {
    const StatusOr<DepthFrame> frame = sequence.Load(0);
    EXPECT_TRUE(frame.ok()) << frame.status().message();
    int count = 0;
    for (const float depth : frame->depth.pixels()) count += depth > 0.0F ? 1 : 0;
    return count;
  }
  // An EndoNeRF folder whose file of poses has these numbers for height, width and focal length.
  void MakeLlff(double first, double second) {
    folder_.Depth("depth/frame-000000.depth.png", 100, 10, 10);
    folder_.Color("images/frame-000000.color.png", 200, 10, 10);
    WriteMask(folder_ / "masks/frame-000000.mask.png", 10);
    NpyArray array;
    array.shape = {1, 17};
    array.values.assign(17, 0.0);
    array.values[4] = first;
    array.values[9] = second;
    array.values[14] = 12.0;
    ASSERT_TRUE(WriteNpyFile(folder_ / "poses_bounds.npy", array).ok());
  }

  SequenceFolder folder_;
};

TEST_F(Traps, PicturesNamedByTimeComeInTheOrderOfTime) {
  folder_.Text("camera.txt", kNativeCamera);
  folder_.Depth("depth/1551915398.6757.png", 1);
  folder_.Depth("depth/1551915399.0001.png", 2);
  folder_.Depth("depth/1551915398.7000.png", 3);
  // A picture of another clock, within 0.02 s.
  folder_.Color("color/1551915398.6800.png", 7);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(0, 1, 2));
  EXPECT_EQ(sequence->time_s(0), 1551915398.6757);
  EXPECT_EQ(sequence->time_s(2), 1551915399.0001);
  EXPECT_THAT(sequence->Load(1)->depth.pixels(), Each(3e-4F));
  EXPECT_EQ(sequence->Load(0)->color(0, 0)[0], 7);
}

TEST_F(Traps, WholeNumbersOfNanosecondsAreTimes) {
  folder_.Text("camera.txt", kNativeCamera);
  folder_.Depth("depth/1551915398675700000.png", 1);
  folder_.Depth("depth/1551915398775700000.png", 2);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(0, 1));
  EXPECT_NEAR(sequence->time_s(1) - sequence->time_s(0), 0.1, 1e-5);
  EXPECT_THAT(sequence->warnings(), IsEmpty());
}

TEST(TimesInNames, UnitIsFoundByTheNumberOfDigits) {
  EXPECT_NEAR(*TimeInName("1551915398675"), 1551915398.675, 1e-6);
  EXPECT_NEAR(*TimeInName("1551915398675700"), 1551915398.6757, 1e-6);
  EXPECT_NEAR(*TimeInName("1551915398675700000"), 1551915398.6757, 1e-6);
  EXPECT_EQ(*TimeInName("12.5"), 12.5);
  EXPECT_FALSE(TimeInName("000123").has_value());
  EXPECT_FALSE(TimeInName("000000000123").has_value());
  EXPECT_FALSE(TimeInName("frame-1").has_value());
  EXPECT_FALSE(TimeInName("1.2.3").has_value());
}

TEST_F(Traps, MasksThatLeaveLittleAreNamed) {
  MakeMasked(6);
  auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(Used(*sequence), 6);
  EXPECT_THAT(
      sequence->warnings(),
      ElementsAre("masks: they leave 6 % of the picture, as white is taken as tissue; if it "
                  "is the tool, mask_means=tool leaves it out"));
  SequenceOptions options;
  options.mask_means = MaskMeans::kTool;
  sequence = Open(options);
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(Used(*sequence), 94);
  EXPECT_THAT(sequence->warnings(), IsEmpty());
}

TEST_F(Traps, MasksOfEndoNerfShowTheTool) {
  MakeLlff(10, 10);
  auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->description(), HasSubstr("endonerf (guessed: there is poses_bounds.npy)"));
  EXPECT_EQ(Used(*sequence), 90);
  SequenceOptions options;
  options.mask_means = MaskMeans::kTissue;
  sequence = Open(options);
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(Used(*sequence), 10);
}

TEST_F(Traps, CentreInThePlaceOfTheSizeMeansMasksOfTissue) {
  MakeLlff(4.5, 5.5);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->description(), HasSubstr("deform3dgs (guessed: "));
  EXPECT_EQ(sequence->camera().cx, 5.5);
  EXPECT_EQ(sequence->camera().cy, 4.5);
  EXPECT_EQ(Used(*sequence), 10);
  EXPECT_THAT(sequence->warnings(), Contains(HasSubstr("taken as cy, cx and focal length")));
  EXPECT_THAT(sequence->warnings(), Contains(HasSubstr("mask_means=tool leaves it out")));
}

TEST_F(Traps, DepthOfEightBitsIsNamed) {
  folder_.Text("camera.txt", "5 6 1.5 1 4 3 1000\n");
  // A grey PNG of 4 x 3 pixels and 8 bits, all 100.
  const unsigned char png[] = {
      0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48,
      0x44, 0x52, 0x00, 0x00, 0x00, 0x04, 0x00, 0x00, 0x00, 0x03, 0x08, 0x00, 0x00, 0x00,
      0x00, 0x91, 0x9F, 0xF1, 0x1A, 0x00, 0x00, 0x00, 0x1A, 0x49, 0x44, 0x41, 0x54, 0x78,
      0x01, 0x01, 0x0F, 0x00, 0xF0, 0xFF, 0x00, 0x64, 0x64, 0x64, 0x64, 0x00, 0x64, 0x64,
      0x64, 0x64, 0x00, 0x64, 0x64, 0x64, 0x64, 0x23, 0x37, 0x04, 0xB1, 0x63, 0xDD, 0x7C,
      0xBA, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
  folder_.Text("depth/0.png", std::string(reinterpret_cast<const char*>(png), sizeof(png)));
  EXPECT_EQ(ShortDepthWarning("x.png", 1000.0), "");
  const std::string path = folder_ / "depth/0.png";
  EXPECT_EQ(ShortDepthWarning(path, 1000.0),
            path +
                ": the depth has 8 bits: steps of 1 mm, and nothing beyond 255 mm; what was "
                "measured finer or farther is lost, expected pictures of 16 bits");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->warnings(), Contains(HasSubstr("the depth has 8 bits")));
}

TEST_F(Traps, OneMaskForTwoFramesServesBoth) {
  SequenceListing listing;
  for (int number = 1; number <= 6; ++number) {
    SequenceEntry entry;
    entry.number = number;
    listing.entries.push_back(entry);
  }
  AddMasksByNumber({{1, "a"}, {3, "b"}, {5, "c"}}, &listing);
  std::vector<std::string> paths;
  for (const SequenceEntry& entry : listing.entries) paths.push_back(entry.mask.path);
  EXPECT_THAT(paths, ElementsAre("a", "a", "b", "b", "c", "c"));
  EXPECT_THAT(listing.warnings,
              ElementsAre("3 masks for 6 frames: 3 frames take that of the frame before"));
}

TEST_F(Traps, MissingCalibrationsAreNamedWithTheirForm) {
  const std::pair<SequenceFormat, const char*> cases[] = {
      {SequenceFormat::kStereoMis,
       "DIR/StereoCalibration.ini: not there, expected the calibration"},
      {SequenceFormat::kScared, "DIR/endoscope_calibration.yaml: not there, expected the calibra"},
      {SequenceFormat::kEndoNerf, "DIR/poses_bounds.npy: not there, expected the calibration of"},
      {SequenceFormat::kD4d, "DIR/camera_info/left_rect.yaml: not there, expected the calibration"},
      {SequenceFormat::kServCt, "DIR/Rectified_calibration/001.json: not there, expected the cali"},
      {SequenceFormat::kSurgT, "DIR/calibration.yaml: not there, expected the calibration of the"},
      {SequenceFormat::kHamlynStereo, "DIR/settings.yaml: not there, expected the calibration of"},
      {SequenceFormat::kDeepDeform, "DIR/intrinsics.txt: not there, expected the calibration of"}};
  for (const auto& [format, sentence] : cases) {
    SequenceOptions options;
    options.format = format;
    EXPECT_THAT(OpenError(folder_, options), HasSubstr(sentence)) << NameOf(format);
  }
}

TEST_F(Traps, CalibrationOfLargerPicturesIsScaledAndNamed) {
  StereoCalibration calibration;
  calibration.rig.left.pinhole =
      calibration.rig.right.pinhole = {1000, 1000, 639.5, 511.5, 1280, 1024};
  ASSERT_TRUE(FitCalibration("c.ini", 640, 512, &calibration).ok());
  EXPECT_EQ(calibration.rig.left.pinhole.fx, 500.0);
  EXPECT_EQ(calibration.rig.right.pinhole.cx, 319.5);
  EXPECT_THAT(calibration.remarks,
              ElementsAre("c.ini: is for pictures of 1280 x 1024 pixels, and these have 640 x 512 "
                          "pixels: the intrinsics are scaled by 0.5"));
  EXPECT_THAT(FitCalibration("c.ini", 640, 480, &calibration).message(),
              HasSubstr("expected the same size or the same ratio of width to height"));
}

TEST_F(Traps, UnpackedStereoMisIsTakenAsRectified) {
  std::string ini;
  for (const char* side : {"StereoLeft", "StereoRight"}) {
    ini += std::string("[") + side +
           "]\nres_x=80\nres_y=80\nfc_x=100\nfc_y=100\ncc_x=39.5\ncc_y=39.5\n";
    for (int i = 0; i < 8; ++i) ini += "kc_" + std::to_string(i) + "=0\n";
  }
  ini += "R_0=1\nR_1=0\nR_2=0\nR_3=0\nR_4=1\nR_5=0\nR_6=0\nR_7=0\nR_8=1\nT_0=-4\nT_1=0\nT_2=0\n";
  folder_.Text("StereoCalibration.ini", ini);
  for (const char* name : {"000001l.png", "000001r.png", "000002l.png", "000002r.png"}) {
    folder_.Color(std::string("video_frames/") + name, 100, 40, 32);
  }
  folder_.Text("groundtruth.txt", "1 0 0 0 0 0 0 1\n2 0 0 0.5 0 0 0 1\n");
  WriteMask(folder_ / "masks/000001l.png", 50);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_TRUE(sequence->is_rectified());
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(1, 2));
  // Scaled by a half, and cut from 40 to 32 rows: the middle stays the middle.
  EXPECT_NEAR(sequence->camera().fx, 50.0, 2.0);
  EXPECT_NEAR(sequence->camera().cx, 19.5, 1.0);
  EXPECT_NEAR(sequence->camera().cy, 15.5, 1.0);
  EXPECT_NEAR(sequence->rig()->right_from_left.translation.x(), -0.004, 1e-6);
  // Row = number - 1.
  EXPECT_EQ(sequence->given_pose(1)->translation.z(), 0.5);
  EXPECT_THAT(sequence->warnings(), Contains(HasSubstr("the pictures are taken as rectified")));
}

TEST_F(Traps, DeepDeformIsNotTakenForHamlyn) {
  folder_.Text("intrinsics.txt", "575 0 1.5 0\n0 575 1 0\n0 0 1 0\n0 0 0 1\n");
  folder_.Depth("depth/000000.png", 1000);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->description(),
              HasSubstr("deepdeform (guessed: there is intrinsics.txt of 4 x 4 numbers)"));
  EXPECT_THAT(sequence->Load(0)->depth.pixels(), Each(1.0F));
}

TEST_F(Traps, PackedPosesOfScaredAreNamed) {
  folder_.Text("endoscope_calibration.yaml",
               "%YAML:1.0\n---\nM1: [100, 0, 2, 0, 100, 1, 0, 0, 1]\nM2: [100, 0, 2, 0, 100, 1, 0, "
               "0, 1]\nD1: [0, 0, 0, 0, 0]\nD2: [0, 0, 0, 0, 0]\nR: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n"
               "T: [-4, 0, 0]\n");
  folder_.Color("Left_Image.png");
  folder_.Color("Right_Image.png");
  folder_.Text("data/frame_data.tar.gz", "packed");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->warnings(), Contains(HasSubstr("unpack the file there: tar -xzf ")));
}

TEST_F(Traps, MasksOfUnknownMeaningAreDecidedByTheirShare) {
  for (const auto& [white, text] : {std::pair(80,
                                              "80 % of the picture are white, so white is taken "
                                              "as tissue"),
                                    std::pair(30,
                                              "30 % of the picture are white, so white is taken "
                                              "as the tool")}) {
    SequenceFolder folder;
    folder.Text("camera_info/left_rect.yaml",
                "width: 10\nheight: 10\nP: [9, 0, 4, 0, 0, 9, 4, 0, 0, 0, 1, 0]\n");
    folder.Text("camera_info/right_rect.yaml",
                "width: 10\nheight: 10\nP: [9, 0, 4, -0.05, 0, 9, 4, 0, 0, 0, 1, 0]\n");
    folder.Color("left_images_rect/1741279780.12.png", 9, 10, 10);
    folder.Color("right_images_rect/1741279780.13.png", 9, 10, 10);
    WriteMask(folder / "left_images_rect_masks/1741279780.12.png", white);
    const auto sequence = OpenSequence(folder.path());
    ASSERT_TRUE(sequence.ok()) << sequence.status().message();
    EXPECT_THAT((*sequence)->warnings(), Contains(HasSubstr(text)));
  }
}

}  // namespace
}  // namespace ceres_ed
