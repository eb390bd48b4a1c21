#include "ceres_ed/io/sequence/depth_sequence.h"
#include "sequence_test_util.h"

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class OpenedSequences : public NativeSequenceTest {};

TEST_F(OpenedSequences, NamesAreSortedByNumberNotByLetter) {
  Make({"10", "9", "100", "8"});
  folder_.Depth("depth/frame_000011.png", 1011);
  folder_.Depth("depth/12.PNG", 1012);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(8, 9, 10, 11, 12, 100));
  for (int i = 0; i < sequence->num_frames(); ++i) {
    const StatusOr<DepthFrame> frame = sequence->Load(i);
    ASSERT_TRUE(frame.ok()) << frame.status().message();
    EXPECT_EQ(frame->depth(0, 0), static_cast<float>((1000 + sequence->frame_number(i)) / 1e4));
  }
}

TEST_F(OpenedSequences, FilesThatAreNoFrameAreLeftOut) {
  Make({"3", "4"});
  folder_.Depth("depth/.000005.png");
  folder_.Depth("depth/mean.png");
  folder_.Depth("depth/6.png/7.png");
  folder_.Text("depth/8.txt", "");
  folder_.Depth("depth/99999999999.png");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(3, 4));
  EXPECT_THAT(Warnings(folder_, *sequence),
              ElementsAre("DIR/depth: names of 2 pictures do not end in a frame number; they are "
                          "left out"));
}

TEST_F(OpenedSequences, WhatIsMissingIsWarnedOf) {
  Make({"0", "1", "2", "5", "6", "7", "10", "11"});
  folder_.Color("color/2.png");
  folder_.Color("color/7.png");
  folder_.Color("mask/0.png");
  folder_.Text("poses.txt",
               "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n3 0 0 0 0 0 0 1\n"
               "5 0 0 0 0 0 0 1\n6 0 0 0 0 0 0 1\n7 0 0 0 0 0 0 1\n10 0 0 0 0 0 0 1\n");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(Warnings(folder_, *sequence),
              ElementsAre("2 gaps in the frame numbers: frame 2 is followed by 5 (the first of "
                          "them)",
                          "6 of 8 frames without colour: 0, 1, 5, 6, 10 ...",
                          "7 of 8 frames without a mask (all of their depth counts): 1, 2, 5, 6, 7 "
                          "...",
                          "1 of 8 frames without a given pose: 11"));
  EXPECT_EQ(sequence->given_pose(7), nullptr);
  EXPECT_NE(sequence->given_pose(6), nullptr);
  const StatusOr<DepthFrame> frame = sequence->Load(1);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_TRUE(frame->color.empty());
  EXPECT_EQ(frame->warning, "");
}

TEST_F(OpenedSequences, NumbersThatGoByTensHaveNoGaps) {
  Make({"0", "10", "20", "30"});
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->warnings(), IsEmpty());
}

TEST_F(OpenedSequences, FirstLastAndStepSelectByNumber) {
  Make({"2", "3", "4", "7", "8", "9"});
  EXPECT_THAT(Numbers(0, -1, 1), ElementsAre(2, 3, 4, 7, 8, 9));
  EXPECT_THAT(Numbers(3, 8, 1), ElementsAre(3, 4, 7, 8));
  EXPECT_THAT(Numbers(5, 100, 1), ElementsAre(7, 8, 9));
  EXPECT_THAT(Numbers(0, -1, 2), ElementsAre(2, 4, 8));
  EXPECT_THAT(Numbers(3, -1, 3), ElementsAre(3, 8));
  EXPECT_THAT(Numbers(9, 9, 100), ElementsAre(9));
}

TEST_F(OpenedSequences, SelectionWithoutFramesIsAnError) {
  Make({"2", "3", "9"});
  SequenceOptions options;
  options.first = 10;
  EXPECT_EQ(OpenError(folder_, options),
            "DIR: first is 10, expected at most 9, the last frame there is");
  options.first = 4;
  options.last = 8;
  EXPECT_EQ(OpenError(folder_, options),
            "DIR: no frame from first = 4 to last = 8, expected some of the frames there are, 2 to "
            "9");
}

TEST_F(OpenedSequences, OptionsOutOfRangeAreErrors) {
  Make({"0"});
  SequenceOptions options;
  options.first = -1;
  EXPECT_EQ(OpenError(folder_, options), "first is -1, expected a whole number >= 0");
  options.first = 5;
  options.last = 4;
  EXPECT_EQ(OpenError(folder_, options), "last is 4, expected at least first, which is 5");
  options.last = -2;
  EXPECT_EQ(OpenError(folder_, options), "last is -2, expected a whole number >= -1 (-1 = end)");
  options = {};
  options.step = 0;
  EXPECT_EQ(OpenError(folder_, options), "step is 0, expected a whole number >= 1");
  options = {};
  options.depth_units_per_metre = -1.0;
  EXPECT_EQ(OpenError(folder_, options),
            "depth_units_per_metre is -1, expected a finite number >= 0 (0 = automatic)");
  options.depth_units_per_metre = std::numeric_limits<double>::infinity();
  EXPECT_EQ(OpenError(folder_, options),
            "depth_units_per_metre is inf, expected a finite number >= 0 (0 = automatic)");
}

TEST_F(OpenedSequences, TwoFilesOfAFrameAreAnError) {
  Make({"1", "2"});
  folder_.Depth("depth/01.png");
  EXPECT_EQ(OpenError(folder_),
            "DIR/depth/01.png: frame 1 is in '1.png' too, expected one file a frame");
  std::filesystem::remove(folder_ / "depth/01.png");
  folder_.Color("color/2.png");
  folder_.Text("color/2.jpg", "");
  EXPECT_EQ(OpenError(folder_),
            "DIR/color/2.jpg: frame 2 is in '2.png' too, expected one file a frame");
}

TEST_F(OpenedSequences, BadCameraPosesOrDepthAreErrors) {
  Make({"1"});
  folder_.Text("camera.txt", "0 6 1.5 1 4 3 10000");
  EXPECT_EQ(OpenError(folder_),
            "DIR/camera.txt: line 1: fx is '0', expected a focal length > 0 pixels");
  folder_.Text("camera.txt", "5 nan 1.5 1 4 3 10000");
  EXPECT_EQ(OpenError(folder_), "DIR/camera.txt: line 1: fy is 'nan', expected a finite number");
  folder_.Text("camera.txt", "5 6 1.5 1 4 3");
  EXPECT_THAT(OpenError(folder_), HasSubstr("DIR/camera.txt: 6 numbers, expected 7"));
  folder_.Text("camera.txt", kNativeCamera);
  folder_.Text("poses.txt", "1 0 0 0 0 0 0 0\n");
  EXPECT_THAT(OpenError(folder_), HasSubstr("DIR/poses.txt: line 1: the quaternion is 0 0 0 0"));
  std::filesystem::remove(folder_ / "depth/1.png");
  EXPECT_EQ(OpenError(folder_), "DIR/depth: no depth, expected at least one NNNNNN.png of 16 bits");
  std::filesystem::remove(folder_ / "depth");
  EXPECT_EQ(OpenError(folder_), "DIR/depth: no such folder, expected depth pictures in it");
}

TEST_F(OpenedSequences, FolderThatIsNoSequenceIsAnErrorThatTellsWhatIsNeeded) {
  const std::string needs =
      ", expected depth.txt (tum), or stereo.txt or calibration.yaml beside one or two videos "
      "(stereo_video), or stereo.txt, left/NNNNNN.png and right/NNNNNN.png (native_stereo), or "
      "camera.txt and depth/NNNNNN.png (native), or intrinsics.txt and depth/ or depth01/ "
      "(hamlyn), "
      "or the files of a data set: stereomis, scared, deform3dgs, endonerf, d4d, servct, surgt, "
      "stir, hamlyn_stereo, c3vd, deepdeform, super, sevenscenes, scikit_surgery";
  EXPECT_EQ(OpenError(folder_), "DIR: the folder is empty" + needs);
  folder_.Depth("depth/0.png");
  EXPECT_EQ(OpenError(folder_), "DIR: no layout of a depth sequence that is known" + needs);
  SequenceOptions options;
  options.format = SequenceFormat::kNative;
  EXPECT_EQ(OpenError(folder_, options), "DIR/camera.txt: cannot read: No such file or directory");
  const std::string missing = folder_ / "none";
  EXPECT_EQ(OpenSequence(missing).status().message(),
            missing + ": no such folder, expected the folder of a depth sequence");
  const std::string file = folder_ / "depth/0.png";
  EXPECT_EQ(OpenSequence(file).status().message(),
            file + ": is a file, expected the folder of a depth sequence");
}

TEST_F(OpenedSequences, FormatThatIsNamedIsNotGuessed) {
  Make({"0"});
  folder_.Text("depth.txt", "");
  SequenceOptions options;
  options.format = SequenceFormat::kNative;
  const auto sequence = Open(options);
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->description(), HasSubstr("native, 1 frame: 0, "));
}

TEST(SequenceFormatNames, AreThoseOfTheTable) {
  for (const NamedValue<SequenceFormat>& named : NamesOf(SequenceFormat())) {
    EXPECT_EQ(FindByName<SequenceFormat>(NameOf(named.value)), named.value);
  }
  EXPECT_EQ(NameOf(SequenceFormat::kHamlyn), "hamlyn");
  EXPECT_FALSE(FindByName<SequenceFormat>("TUM").has_value());
  EXPECT_EQ(ListNames<SequenceFormat>(", "),
            "auto, tum, native, hamlyn, native_stereo, scikit_surgery, stereo_video, stereomis, "
            "scared, endonerf, deform3dgs, d4d, servct, surgt, stir, hamlyn_stereo, c3vd, "
            "deepdeform, super, sevenscenes");
}

}  // namespace
}  // namespace ceres_ed
