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

constexpr char kIntrinsics[] = "383.19 0 1.75 0\n0 384.5 1.25 0\n0 0 1 0\n";

class HamlynSequences : public ::testing::Test {
 protected:
  std::unique_ptr<DepthSequence> Open() {
    StatusOr<std::unique_ptr<DepthSequence>> sequence = OpenSequence(folder_.path());
    if (!sequence.ok()) {
      ADD_FAILURE() << sequence.status().message();
      return nullptr;
    }
    return std::move(*sequence);
  }
  std::string IntrinsicsError(const std::string& text) {
    folder_.Depth("depth/1.png");
    folder_.Text("intrinsics.txt", text);
    return OpenError(folder_);
  }

  SequenceFolder folder_;
};

TEST_F(HamlynSequences, BothPairsOfFoldersAreKnown) {
  for (const auto& [depth, color] : std::vector<std::pair<std::string, std::string>>{
           {"depth01/", "image01/"}, {"depth/", "color/"}}) {
    SequenceFolder folder;
    folder.Text("intrinsics.txt", kIntrinsics);
    for (const int number : {9, 10, 11}) {
      folder.Depth(depth + std::to_string(number) + ".png", 100 + number, 8, 6);
      folder.Color(
          color + std::to_string(number) + ".png", static_cast<std::uint8_t>(number), 8, 6);
    }
    const auto sequence = OpenSequence(folder.path());
    ASSERT_TRUE(sequence.ok()) << sequence.status().message();
    EXPECT_THAT(FrameNumbers(**sequence), ElementsAre(9, 10, 11));
    EXPECT_THAT((*sequence)->warnings(), IsEmpty());
    EXPECT_EQ((*sequence)->description(),
              "hamlyn (guessed: there is intrinsics.txt), 3 frames: 9 to 11, 8 x 6 pixels, 1000 "
              "depth units per metre, colour, no masks, no poses");
    const PinholeCamera& camera = (*sequence)->camera();
    EXPECT_EQ(camera.fx, 383.19);
    EXPECT_EQ(camera.fy, 384.5);
    EXPECT_EQ(camera.cx, 1.75);
    EXPECT_EQ(camera.cy, 1.25);
    const StatusOr<DepthFrame> frame = (*sequence)->Load(1);
    ASSERT_TRUE(frame.ok()) << frame.status().message();
    EXPECT_EQ(frame->time_s, 10.0);
    EXPECT_THAT(frame->depth.pixels(), Each(0.11F));
    EXPECT_EQ(frame->color(7, 5)[0], 10);
  }
}

TEST_F(HamlynSequences, ThreeColumnsAndCommentsAreFine) {
  folder_.Depth("depth01/0.png");
  folder_.Text("intrinsics.txt", "# left\n5 0 2\n0 6 1e0\n\n0.0 0 1.0\n");
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(sequence->camera().fy, 6.0);
  EXPECT_EQ(sequence->camera().cy, 1.0);
  EXPECT_FALSE(sequence->has_color());
}

TEST_F(HamlynSequences, SizeIsOfTheFirstPictureThatCanBeRead) {
  folder_.Text("intrinsics.txt", kIntrinsics);
  folder_.Text("depth/1.png", "damaged");
  folder_.Depth("depth/2.png", 100, 7, 5);
  folder_.Depth("depth/3.png", 100, 9, 5);
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(sequence->camera().width, 7);
  EXPECT_EQ(sequence->camera().height, 5);
  FrameProblem problem = FrameProblem::kNone;
  EXPECT_FALSE(sequence->Load(0, &problem).ok());
  EXPECT_EQ(problem, FrameProblem::kUnreadable);
  EXPECT_FALSE(sequence->Load(2, &problem).ok());
  EXPECT_EQ(problem, FrameProblem::kWrongSize);
  EXPECT_TRUE(sequence->Load(1, &problem).ok());
  EXPECT_EQ(problem, FrameProblem::kNone);
  std::filesystem::remove(folder_ / "depth/2.png");
  std::filesystem::remove(folder_ / "depth/3.png");
  EXPECT_THAT(OpenError(folder_), HasSubstr("DIR/depth/1.png: "));
}

TEST_F(HamlynSequences, MaskTakesDepthAway) {
  folder_.Text("intrinsics.txt", kIntrinsics);
  folder_.Depth("depth/1.png");
  ASSERT_TRUE(std::filesystem::create_directory(folder_ / "mask"));
  ASSERT_TRUE(WriteColorImage(folder_ / "mask/1.png", ColorImage(4, 3)).ok());
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_THAT(frame->depth.pixels(), Each(0.0F));
}

TEST_F(HamlynSequences, BadIntrinsicsAreErrors) {
  EXPECT_EQ(IntrinsicsError("5 0 2\n0 6 1\n"),
            "DIR/intrinsics.txt: 2 rows, expected 3 rows of 3 or 4 numbers: fx 0 cx, 0 fy cy, 0 0 "
            "1");
  EXPECT_EQ(
      IntrinsicsError("5 0 2\n0 6\n0 0 1\n"),
      "DIR/intrinsics.txt: line 2: 2 numbers, expected 3 or 4 in each of 3 rows of the camera "
      "matrix");
  EXPECT_EQ(IntrinsicsError("5 0 2\n0 6 1\n0 0 1\n0 0 0\n"),
            "DIR/intrinsics.txt: line 4: a fourth row, expected 3 rows of 3 or 4 numbers");
  EXPECT_EQ(IntrinsicsError("5 0 2\n0 inf 1\n0 0 1\n"),
            "DIR/intrinsics.txt: line 2: column 2 is 'inf', expected a finite number");
  EXPECT_EQ(IntrinsicsError("0 0 2\n0 6 1\n0 0 1\n"),
            "DIR/intrinsics.txt: fx is 0, expected a focal length > 0 pixels");
  EXPECT_EQ(IntrinsicsError("5 0 2\n0 -6 1\n0 0 1\n"),
            "DIR/intrinsics.txt: fy is -6, expected a focal length > 0 pixels");
  for (const char* text :
       {"5 1 2\n0 6 1\n0 0 1\n", "5 0 2\n0 6 1\n0 0 2\n", "5 0 0\n0 6 0\n2 1 1\n"}) {
    EXPECT_EQ(IntrinsicsError(text),
              "DIR/intrinsics.txt: the rows are no camera matrix of a rectified picture, expected "
              "fx 0 cx, 0 fy cy, 0 0 1");
  }
}

TEST_F(HamlynSequences, IntrinsicsOfLargerPicturesAreAnError) {
  folder_.Text("intrinsics.txt", "600 0 322\n0 600 238\n0 0 1\n");
  folder_.Depth("depth01/1.png", 1000, 320, 240);
  EXPECT_EQ(OpenError(folder_),
            "DIR/intrinsics.txt: the principal point (322, 238) is outside the pictures of 320 x "
            "240 pixels, expected the intrinsics of these pictures: if they were resized, multiply "
            "fx, fy, cx and cy by the same factor");
}

TEST_F(HamlynSequences, NoDepthIsAnError) {
  folder_.Text("intrinsics.txt", kIntrinsics);
  EXPECT_EQ(OpenError(folder_), "DIR: no depth, expected a folder depth/ or depth01/ in it");
  folder_.Text("depth01/1.jpg", "");
  EXPECT_EQ(OpenError(folder_),
            "DIR/depth01: no depth, expected at least one NNNNNN.png of 16 bits");
}

}  // namespace
}  // namespace ceres_ed
