#include "ceres_ed/io/sequence/depth_sequence.h"

#include "sequence_test_util.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class LoadedFrames : public NativeSequenceTest {};

TEST_F(LoadedFrames, EverythingOfAFrameIsRead) {
  Make({"000000", "000001"});
  folder_.Color("color/000000.png", 50);
  folder_.Color("color/000001.png", 51);
  folder_.Text("poses.txt", "0 1 2 3 0 0 0 1\n1 4 5 6 0 0 1 0\n");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(sequence->num_frames(), 2);
  EXPECT_EQ(sequence->camera().fx, 5.0);
  EXPECT_EQ(sequence->camera().fy, 6.0);
  EXPECT_EQ(sequence->camera().cx, 1.5);
  EXPECT_EQ(sequence->camera().cy, 1.0);
  EXPECT_EQ(sequence->camera().width, 4);
  EXPECT_EQ(sequence->camera().height, 3);
  EXPECT_EQ(sequence->depth_units_per_metre(), 10000.0);
  EXPECT_TRUE(sequence->has_color());
  EXPECT_THAT(sequence->warnings(), IsEmpty());
  EXPECT_EQ(sequence->description(),
            "native (guessed: there is camera.txt), 2 frames: 0 to 1, 4 x 3 pixels, 10000 depth "
            "units per metre, colour, no masks, poses");
  ASSERT_NE(sequence->given_pose(1), nullptr);
  EXPECT_EQ(sequence->given_pose(1)->translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(sequence->time_s(1), 1.0);

  FrameProblem problem = FrameProblem::kWrongSize;
  const StatusOr<DepthFrame> frame = sequence->Load(1, &problem);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_EQ(problem, FrameProblem::kNone);
  EXPECT_EQ(frame->number, 1);
  EXPECT_EQ(frame->time_s, 1.0);
  EXPECT_EQ(frame->depth.width(), 4);
  EXPECT_EQ(frame->depth.height(), 3);
  EXPECT_THAT(frame->depth.pixels(), Each(0.1001F));
  EXPECT_EQ(frame->color(3, 2)[0], 51);
  EXPECT_EQ(frame->warning, "");
}

TEST_F(LoadedFrames, DepthAloneIsEnough) {
  Make({"0"});
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_FALSE(sequence->has_color());
  EXPECT_EQ(sequence->given_pose(0), nullptr);
  EXPECT_THAT(sequence->warnings(), IsEmpty());
  EXPECT_EQ(
      sequence->description(),
      "native (guessed: there is camera.txt), 1 frame: 0, 4 x 3 pixels, 10000 depth units per "
      "metre, no colour, no masks, no poses");
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_TRUE(frame->color.empty());
}

TEST_F(LoadedFrames, UnitOfTheOptionsWins) {
  Make({"0"});
  SequenceOptions options;
  options.depth_units_per_metre = 500.0;
  const auto sequence = Open(options);
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(sequence->depth_units_per_metre(), 500.0);
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_THAT(frame->depth.pixels(), Each(2.0F));
}

TEST_F(LoadedFrames, ColorIsLeftAsideOnRequest) {
  Make({"0", "1"});
  folder_.Color("color/0.png");
  SequenceOptions options;
  options.color = false;
  const auto sequence = Open(options);
  ASSERT_NE(sequence, nullptr);
  EXPECT_FALSE(sequence->has_color());
  EXPECT_THAT(sequence->warnings(), IsEmpty());
  EXPECT_THAT(sequence->description(), HasSubstr("no colour"));
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_TRUE(frame->color.empty());
}

TEST_F(LoadedFrames, MasksAreLeftAsideOnRequest) {
  Make({"0"});
  folder_.Color("mask/0.png");
  ASSERT_TRUE(WriteColorImage(folder_ / "mask/0.png", ColorImage(4, 3)).ok());
  SequenceOptions options;
  options.masks = false;
  const auto sequence = Open(options);
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->description(), HasSubstr("no masks"));
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_THAT(frame->depth.pixels(), Each(::testing::Gt(0.0F)));
}

TEST_F(LoadedFrames, MaskTakesDepthAway) {
  Make({"0"});
  ColorImage mask(4, 3);
  mask(2, 1) = {255, 255, 255};
  folder_.Color("mask/0.png");
  ASSERT_TRUE(WriteColorImage(folder_ / "mask/0.png", mask).ok());
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 4; ++u) {
      EXPECT_EQ(frame->depth(u, v), u == 2 && v == 1 ? 0.1F : 0.0F) << u << ' ' << v;
    }
  }
}

TEST_F(LoadedFrames, UnreadableFrameInTheMiddleIsToldApartAndOthersLoad) {
  Make({"0", "1", "2", "3", "4"});
  folder_.Text("depth/1.png", "damaged");
  folder_.Color("depth/2.png");
  folder_.Text("mask/3.png", "");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  for (const auto& [frame, file] : std::vector<std::pair<int, std::string>>{
           {1, "depth/1.png"}, {2, "depth/2.png"}, {3, "mask/3.png"}}) {
    FrameProblem problem = FrameProblem::kNone;
    EXPECT_THAT(sequence->Load(frame, &problem).status().message(),
                HasSubstr(folder_ / (file + ": ")));
    EXPECT_EQ(problem, FrameProblem::kUnreadable) << frame;
  }
  EXPECT_TRUE(sequence->Load(0).ok());
  EXPECT_TRUE(sequence->Load(4).ok());
  std::filesystem::remove(folder_ / "depth/4.png");
  FrameProblem problem = FrameProblem::kNone;
  EXPECT_FALSE(sequence->Load(4, &problem).ok());
  EXPECT_EQ(problem, FrameProblem::kUnreadable);
}

TEST_F(LoadedFrames, OtherSizeThanTheCameraIsToldApart) {
  Make({"0", "1", "2", "3"});
  folder_.Depth("depth/1.png", 1000, 3, 4);
  folder_.Color("mask/2.png", 255, 2, 3);
  folder_.Color("color/3.png", 255, 8, 6);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  for (const auto& [frame, message] : std::vector<std::pair<int, std::string>>{
           {1, "depth/1.png: 3 x 4 pixels, expected 4 x 3 pixels as the camera has"},
           {2, "mask/2.png: 2 x 3 pixels, expected 4 x 3 pixels as the camera has"},
           {3,
            "color/3.png: 8 x 6 pixels, expected 4 x 3 pixels as the camera has; if they were "
            "resized, multiply fx, fy, cx and cy of the calibration by 2"}}) {
    FrameProblem problem = FrameProblem::kNone;
    EXPECT_EQ(sequence->Load(frame, &problem).status().message(), folder_ / message);
    EXPECT_EQ(problem, FrameProblem::kWrongSize) << frame;
  }
  EXPECT_TRUE(sequence->Load(0).ok());
}

TEST_F(LoadedFrames, DamagedColorLeavesTheDepth) {
  Make({"0"});
  folder_.Text("color/0.jpg", "damaged");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_TRUE(frame->color.empty());
  EXPECT_THAT(frame->depth.pixels(), Each(0.1F));
  EXPECT_THAT(frame->warning, HasSubstr("color/0.jpg: "));
}

TEST_F(LoadedFrames, FrameOfInvalidPixelsLoads) {
  Make({"0"});
  folder_.Depth("depth/0.png", 0);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_THAT(frame->depth.pixels(), Each(0.0F));
}

TEST(DepthRange, WarnsOutsideOfAMillimetreToAHundredMetres) {
  EXPECT_EQ(DepthRangeWarning(DepthImage(2, 2, 0.3F), 1000.0), "");
  EXPECT_EQ(DepthRangeWarning(DepthImage(2, 2, 0.00101F), 1000.0), "");
  EXPECT_EQ(DepthRangeWarning(DepthImage(2, 2, 99.9F), 1000.0), "");
  EXPECT_EQ(DepthRangeWarning(DepthImage(2, 2, 0.0005F), 1e7),
            "the scene is 0.0005 m away, nearer than 1 mm: is the depth really stored as 1e+07 "
            "units per metre? With depth_units_per_metre=1000 (millimetres) it would be 5 m away.");
  EXPECT_EQ(DepthRangeWarning(DepthImage(2, 2, 300.0F), 1.0),
            "the scene is 300 m away, farther than 100 m: is the depth really stored as 1 units "
            "per metre? With depth_units_per_metre=1000 (millimetres) it would be 0.3 m away.");
}

TEST(DepthRange, ProposesTheUnitThatPlacesTheSceneBeforeACamera) {
  const auto proposed = [](float metres, double units) {
    return DepthRangeWarning(DepthImage(2, 2, metres), units);
  };
  // Millimetres that were declared as micrometres, metres as millimetres, micrometres as metres.
  EXPECT_THAT(proposed(80e-6F, 1e6), HasSubstr("depth_units_per_metre=1000 (millimetres)"));
  EXPECT_THAT(proposed(0.5e-3F, 1e3), HasSubstr("depth_units_per_metre=1 (metres)"));
  EXPECT_THAT(proposed(80e3F, 1.0), HasSubstr("depth_units_per_metre=1e+06 (micrometres)"));
  // A scene of kilometres in no unit.
  EXPECT_THAT(proposed(3e9F, 1.0), Not(HasSubstr("With")));
}

TEST(DepthRange, WarnsOfWholeNumbersOfACoarseUnit) {
  DepthImage depth(2, 1, 0.0F);
  depth.pixels() = {80.0F, 79.0F};
  EXPECT_EQ(DepthRangeWarning(depth, 1.0),
            "the scene is 80 m away and measured in steps of 1 m, coarser than depth cameras have: "
            "is the depth really stored as 1 units per metre? With depth_units_per_metre=1000 "
            "(millimetres) it would be 0.08 m away.");
  EXPECT_EQ(DepthRangeWarning(depth, 1000.0), "");
  depth.pixels() = {80.5F, 79.0F};
  EXPECT_EQ(DepthRangeWarning(depth, 1.0), "");
}

TEST(DepthRange, CountsMeasuredPixelsOnly) {
  DepthImage depth(5, 1, 0.0F);
  EXPECT_EQ(DepthRangeWarning(depth, 1.0), "");
  EXPECT_EQ(DepthRangeWarning(DepthImage(), 1.0), "");
  depth.pixels() = {0.0F, 0.0F, 0.0F, 200.0F, 0.0F};
  EXPECT_NE(DepthRangeWarning(depth, 1.0), "");
  depth.pixels() = {200.0F, 200.0F, 2.5F, 2.5F, 2.5F};
  EXPECT_EQ(DepthRangeWarning(depth, 1.0), "");
}

}  // namespace
}  // namespace ceres_ed
