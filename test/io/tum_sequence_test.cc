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

class TumSequences : public ::testing::Test {
 protected:
  // Writes depth images 0.png, 1.png ... at the given times. All pixels of an image are 5000 +
  // index units.
  void Make(const std::vector<std::string>& times) {
    std::string list = "# depth maps\n# timestamp filename\n";
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::string name = "depth/" + std::to_string(i) + ".png";
      folder_.Depth(name, 5000 + static_cast<int>(i));
      list += times[i] + " " + name + "\n";
    }
    folder_.Text("depth.txt", list);
  }
  // Writes colour images whose red channel is their index.
  void MakeColors(const std::vector<std::string>& times) {
    std::string list = "# color images\n";
    for (std::size_t i = 0; i < times.size(); ++i) {
      const std::string name = "rgb/" + std::to_string(i) + ".png";
      folder_.Color(name, static_cast<std::uint8_t>(i));
      list += times[i] + " " + name + "\n";
    }
    folder_.Text("rgb.txt", list);
  }
  std::unique_ptr<DepthSequence> Open(const std::string& path) {
    StatusOr<std::unique_ptr<DepthSequence>> sequence = OpenSequence(path);
    if (!sequence.ok()) {
      ADD_FAILURE() << sequence.status().message();
      return nullptr;
    }
    return std::move(*sequence);
  }
  // Returns the colour image of each frame, -1 for none.
  std::vector<int> Reds() {
    std::vector<int> reds;
    const auto sequence = Open(folder_.path());
    for (int i = 0; sequence != nullptr && i < sequence->num_frames(); ++i) {
      const StatusOr<DepthFrame> frame = sequence->Load(i);
      EXPECT_TRUE(frame.ok()) << frame.status().message();
      if (!frame.ok()) continue;
      reds.push_back(frame->color.empty() ? -1 : frame->color(0, 0)[0]);
    }
    return reds;
  }

  SequenceFolder folder_;
};

TEST_F(TumSequences, FramesAreNumberedByTimeAndDepthIsDividedBy5000) {
  Make({"1305031102.2", "1305031102.1", "1305031102.3"});
  const auto sequence = Open(folder_.path());
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(0, 1, 2));
  EXPECT_EQ(sequence->time_s(0), 1305031102.1);
  EXPECT_EQ(sequence->depth_units_per_metre(), 5000.0);
  EXPECT_EQ(sequence->camera().width, 4);
  EXPECT_EQ(sequence->camera().height, 3);
  EXPECT_FALSE(sequence->has_color());
  EXPECT_THAT(sequence->description(), HasSubstr("tum (guessed: there is depth.txt), 3 frames"));
  const StatusOr<DepthFrame> frame = sequence->Load(0);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_THAT(frame->depth.pixels(), Each(static_cast<float>(5001.0 / 5000.0)));
  EXPECT_EQ(frame->time_s, 1305031102.1);
}

TEST_F(TumSequences, ColorIsTheNearestInTimeWithin20Milliseconds) {
  Make({"10.00", "10.10", "10.20", "10.30"});
  MakeColors({"10.015", "9.99", "10.119", "10.221", "10.295"});
  // For 10.00, 9.99 is nearer than 10.015. For 10.20, a difference of 0.021 s is too large.
  EXPECT_THAT(Reds(), ElementsAre(1, 2, -1, 4));
  const auto sequence = Open(folder_.path());
  ASSERT_NE(sequence, nullptr);
  EXPECT_TRUE(sequence->has_color());
  EXPECT_THAT(sequence->warnings(), ::testing::Contains("1 of 4 frames without colour: 2"));
}

TEST_F(TumSequences, ColorBelongsToOneFrameTheNearest) {
  // Image 0 is near enough to both frames; the second one is nearer.
  Make({"10.000", "10.025"});
  MakeColors({"10.014"});
  EXPECT_THAT(Reds(), ElementsAre(-1, 0));
  // The frame whose nearest image is taken by another one gets the next image.
  MakeColors({"9.985", "10.014"});
  EXPECT_THAT(Reds(), ElementsAre(0, 1));
}

TEST_F(TumSequences, PosesAreTheNearestInTimeWithin20Milliseconds) {
  Make({"10.0", "10.1", "10.2", "10.3"});
  folder_.Text("groundtruth.txt",
               "# timestamp tx ty tz qx qy qz qw\n10.119 3 0 0 0 0 0 1\n10.09 2 0 0 0 0 0 1\n"
               "9.985 1 0 0 0 0 0 1\n10.221 4 0 0 0 0 0 1\n10.279 5 0 0 0 0 0 1\n");
  const auto sequence = Open(folder_.path());
  ASSERT_NE(sequence, nullptr);
  ASSERT_NE(sequence->given_pose(0), nullptr);
  EXPECT_EQ(sequence->given_pose(0)->translation.x(), 1.0);
  ASSERT_NE(sequence->given_pose(1), nullptr);
  EXPECT_EQ(sequence->given_pose(1)->translation.x(), 2.0);
  EXPECT_EQ(sequence->given_pose(2), nullptr);
  EXPECT_EQ(sequence->given_pose(3), nullptr);
  EXPECT_THAT(sequence->warnings(),
              ::testing::Contains("2 of 4 frames without a given pose: 2, 3"));
}

TEST_F(TumSequences, IntrinsicsOfTheFileWin) {
  Make({"1"});
  folder_.Text("camera.txt", "5 6 1.5 1 4 3 1000");
  const auto sequence = Open(folder_.path());
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(sequence->camera().fx, 5.0);
  EXPECT_EQ(sequence->depth_units_per_metre(), 1000.0);
  EXPECT_THAT(sequence->warnings(), IsEmpty());
  folder_.Text("camera.txt", "0 6 1.5 1 4 3 1000");
  EXPECT_THAT(OpenError(folder_), HasSubstr("DIR/camera.txt: line 1: fx is '0'"));
}

TEST_F(TumSequences, IntrinsicsFollowFromTheNameOfTheFolder) {
  struct Case {
    const char* name;
    double fx, fy, cx, cy;
  };
  for (const Case& expected : {Case{"rgbd_dataset_freiburg1_xyz", 517.3, 516.5, 318.6, 255.3},
                               Case{"rgbd_dataset_freiburg2_desk", 520.9, 521.0, 325.1, 249.7},
                               Case{"fr3_office", 535.4, 539.2, 320.1, 247.6}}) {
    const std::string name = expected.name;
    folder_.Depth(name + "/d.png", 5000, 640, 480);
    folder_.Text(name + "/depth.txt", "1.0 d.png\n");
    for (const std::string& path :
         {folder_ / name, folder_ / (name + "/"), folder_ / (name + "/.")}) {
      const auto sequence = Open(path);
      ASSERT_NE(sequence, nullptr);
      EXPECT_EQ(sequence->camera().fx, expected.fx) << path;
      EXPECT_EQ(sequence->camera().fy, expected.fy);
      EXPECT_EQ(sequence->camera().cx, expected.cx);
      EXPECT_EQ(sequence->camera().cy, expected.cy);
      EXPECT_EQ(sequence->camera().width, 640);
      EXPECT_EQ(sequence->camera().height, 480);
      EXPECT_THAT(sequence->warnings(), IsEmpty());
    }
  }
}

TEST_F(TumSequences, IntrinsicsThatAreAssumedAreWarnedOf) {
  folder_.Depth("d.png", 5000, 640, 480);
  folder_.Text("depth.txt", "1.0 d.png\n");
  const auto sequence = Open(folder_.path());
  ASSERT_NE(sequence, nullptr);
  EXPECT_EQ(sequence->camera().fx, 525.0);
  EXPECT_EQ(sequence->camera().fy, 525.0);
  EXPECT_EQ(sequence->camera().cx, 319.5);
  EXPECT_EQ(sequence->camera().cy, 239.5);
  EXPECT_THAT(Warnings(folder_, *sequence),
              ElementsAre("DIR/camera.txt: not there, and the folder's name tells no sensor "
                          "(freiburg1, 2 or 3); fx fy cx cy are taken as 525 525 319.5 239.5"));
  folder_.Depth("d.png", 5000, 320, 240);
  const auto small = Open(folder_.path());
  ASSERT_NE(small, nullptr);
  EXPECT_THAT(Warnings(folder_, *small),
              ::testing::Contains("DIR/camera.txt: not there, and the pictures have 320 x 240 "
                                  "pixels; the intrinsics assumed are those of 640 x 480"));
}

TEST_F(TumSequences, FilesThatAreNotThereLeaveTheirNumbersOut) {
  Make({"1", "2", "3", "4"});
  MakeColors({"1", "2", "3", "4"});
  folder_.Text("camera.txt", "5 6 1.5 1 4 3 5000");
  std::filesystem::remove(folder_ / "depth/1.png");
  std::filesystem::remove(folder_ / "rgb/3.png");
  const auto sequence = Open(folder_.path());
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(FrameNumbers(*sequence), ElementsAre(0, 2, 3));
  EXPECT_THAT(Warnings(folder_, *sequence),
              ElementsAre("DIR/depth.txt: 1 of 4 files are not there",
                          "1 gap in the frame numbers: frame 0 is followed by 2",
                          "1 of 3 frames without colour: 3"));
  EXPECT_THAT(Reds(), ElementsAre(0, 2, -1));
}

TEST_F(TumSequences, BadListsAreErrors) {
  folder_.Text("depth.txt", "# nothing\n");
  EXPECT_EQ(
      OpenError(folder_),
      "DIR/depth.txt: no depth: names 0 files, none of which is there, expected at least one");
  folder_.Text("depth.txt", "1 none.png\n");
  EXPECT_THAT(OpenError(folder_), HasSubstr("names 1 files, none of which is there"));
  folder_.Text("depth.txt", "# c\n1\n");
  EXPECT_EQ(OpenError(folder_), "DIR/depth.txt: line 2: 1 field, expected 2: timestamp filename");
  folder_.Text("depth.txt", "nan d.png\n");
  EXPECT_EQ(OpenError(folder_),
            "DIR/depth.txt: line 1: timestamp is 'nan', expected a finite number");
  folder_.Text("depth.txt", "2 b.png\n1 c.png\n2.0 a.png\n");
  EXPECT_EQ(OpenError(folder_),
            "DIR/depth.txt: 'DIR/b.png' and 'DIR/a.png' have the same timestamp, expected one "
            "picture a moment");
  Make({"1"});
  folder_.Text("rgb.txt", "1 a b c\n");
  EXPECT_EQ(OpenError(folder_), "DIR/rgb.txt: line 1: 4 fields, expected 2: timestamp filename");
  std::filesystem::remove(folder_ / "rgb.txt");
  folder_.Text("groundtruth.txt", "1 0 0 0 0 0 0\n");
  EXPECT_THAT(OpenError(folder_), HasSubstr("DIR/groundtruth.txt: line 1: 7 fields, expected 8"));
  SequenceFolder empty;
  SequenceOptions options;
  options.format = SequenceFormat::kTum;
  EXPECT_EQ(OpenError(empty, options), "DIR/depth.txt: cannot read: No such file or directory");
}

}  // namespace
}  // namespace ceres_ed
