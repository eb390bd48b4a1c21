// Stereo recordings that are videos: stacked in each way, or one file a camera.
#include "../io/sequence_test_util.h"
#include "ceres_ed/io/sequence/depth_sequence.h"
#include "ceres_ed/io/video/video_file.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr int kFrames = 5;
constexpr char kStereo[] = "80 80 31.5 31.5 23.5 64 48 0.005\n";

// Smooth blobs, which get brighter from frame to frame, and which the right camera sees further to
// the left.
ColorImage Picture(bool is_right, int frame) {
  ColorImage picture(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double x = is_right ? u + 6 : u;
      const double value = 90 + 8 * frame + 40 * std::sin(0.2 * x) + 30 * std::cos(0.15 * v);
      const auto grey = static_cast<std::uint8_t>(value);
      picture(u, v) = {grey, grey, grey};
    }
  }
  return picture;
}

enum class Kind { kVertical, kHorizontal, kRows };

ColorImage Stacked(Kind kind, int frame) {
  const bool is_wide = kind == Kind::kHorizontal;
  ColorImage both(is_wide ? 2 * kWidth : kWidth, is_wide ? kHeight : 2 * kHeight);
  for (const bool is_right : {false, true}) {
    const ColorImage one = Picture(is_right, frame);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const int column = is_wide && is_right ? u + kWidth : u;
        const int lower = kind == Kind::kVertical && is_right ? v + kHeight : v;
        const int row = kind == Kind::kRows ? 2 * v + (is_right ? 1 : 0) : lower;
        both(column, row) = one(u, v);
      }
    }
  }
  return both;
}

class StereoVideos : public ::testing::Test {
 protected:
  template <typename Make>
  void Write(const std::string& name, const Make& make) {
    std::unique_ptr<VideoEncoder> video;
    for (int frame = 0; frame < kFrames; ++frame) {
      const ColorImage picture = make(frame);
      if (video == nullptr) {
        auto created = CreateVideo(folder_ / name, picture.width(), picture.height(), 25.0);
        ASSERT_TRUE(created.ok()) << created.status().message();
        video = *std::move(created);
      }
      ASSERT_TRUE(video->Add(picture).ok());
    }
    ASSERT_TRUE(video->Close().ok());
  }
  std::unique_ptr<DepthSequence> Open() {
    StatusOr<std::unique_ptr<DepthSequence>> sequence = OpenSequence(folder_.path());
    if (sequence.ok()) return std::move(*sequence);
    ADD_FAILURE() << sequence.status().message();
    return nullptr;
  }
  // The frames are those that were written, up to the rounding of colours.
  void ExpectFrames(const DepthSequence& sequence) {
    ASSERT_EQ(sequence.num_frames(), kFrames);
    for (const int i : {0, 3, 1, 4}) {
      const StatusOr<DepthFrame> frame = sequence.Load(i);
      ASSERT_TRUE(frame.ok()) << frame.status().message();
      EXPECT_LE(LargestDifference(frame->color, Picture(false, i)), 3) << i;
      EXPECT_LE(LargestDifference(frame->right, Picture(true, i)), 3) << i;
    }
    EXPECT_NEAR(sequence.time_s(2), 0.08, 1e-9);
  }
  static int LargestDifference(const ColorImage& a, const ColorImage& b) {
    EXPECT_EQ(a.width(), b.width());
    EXPECT_EQ(a.height(), b.height());
    int largest = 0;
    for (std::size_t i = 0; i < std::min(a.pixels().size(), b.pixels().size()); ++i) {
      largest = std::max(largest, std::abs(a.pixels()[i][1] - b.pixels()[i][1]));
    }
    return largest;
  }

  SequenceFolder folder_;
};

TEST_F(StereoVideos, AreSplitInEachWay) {
  const std::pair<Kind, const char*> kinds[] = {
      {Kind::kVertical, "the left picture above the right one"},
      {Kind::kHorizontal, "the left picture to the left of the right one"},
      {Kind::kRows, "rows of the left and of the right picture in turn"}};
  for (const auto& [kind, text] : kinds) {
    folder_.Text("stereo.txt", kStereo);
    Write("recording.avi", [kind = kind](int frame) { return Stacked(kind, frame); });
    const auto sequence = Open();
    ASSERT_NE(sequence, nullptr);
    EXPECT_THAT(sequence->description(),
                HasSubstr("stereo_video (guessed: there is stereo.txt or "));
    EXPECT_THAT(sequence->warnings(), Contains(HasSubstr(text)));
    ExpectFrames(*sequence);
    std::filesystem::remove(folder_ / "recording.avi");
  }
}

TEST_F(StereoVideos, MayBeOneFileForEachCamera) {
  folder_.Text("stereo.txt", kStereo);
  // The order of the names is not that of the cameras.
  Write("a_right.avi", [](int frame) { return Picture(true, frame); });
  Write("b_left.avi", [](int frame) { return Picture(false, frame); });
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->warnings(), Contains(HasSubstr("b_left.avi: is taken as the left camera")));
  ExpectFrames(*sequence);
}

TEST_F(StereoVideos, OfHamlynMayBeStacked) {
  folder_.Text("settings.yaml",
               "%YAML:1.0\n\nCamera.fx: 80\nCamera.fy: 80\nCamera.cx: 31.5\nCamera.cy: 23.5\n"
               "Camera.bf: 400\n");
  Write("f7.avi", [](int frame) { return Stacked(Kind::kHorizontal, frame); });
  const auto sequence = Open();
  ASSERT_NE(sequence, nullptr);
  EXPECT_THAT(sequence->description(), HasSubstr("hamlyn_stereo (guessed: "));
  EXPECT_TRUE(sequence->is_rectified());
  ExpectFrames(*sequence);
}

TEST_F(StereoVideos, MoreThanTwoAreAnError) {
  folder_.Text("stereo.txt", kStereo);
  for (const char* name : {"a.avi", "b.avi", "c.avi"}) folder_.Text(name, "");
  EXPECT_EQ(OpenError(folder_),
            "DIR: has 3 videos, expected one with both pictures, or one a camera");
}

TEST_F(StereoVideos, WithoutASizeThatFitsAreAnError) {
  folder_.Text("stereo.txt", "80 80 63.5 63.5 47.5 128 80 0.005\n");
  Write("recording.avi", [](int frame) { return Stacked(Kind::kVertical, frame); });
  EXPECT_THAT(OpenError(folder_),
              HasSubstr("is for pictures of 128 x 80 pixels, and these have 64 x 48 pixels"));
}

}  // namespace
}  // namespace ceres_ed
