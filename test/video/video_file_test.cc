#include "ceres_ed/io/video/video_file.h"

#include "../io/io_test_util.h"
#include "ceres_ed/io/video/stacking.h"

#include <cmath>
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

// Every pixel says which frame this is.
ColorImage Plain(int frame) {
  const auto grey = static_cast<std::uint8_t>(10 * frame + 20);
  return {kWidth, kHeight, {grey, grey, grey}};
}

// Smooth blobs, which the right camera sees `disparity` pixels further to the left.
std::uint8_t Scene(double u, double v) {
  return static_cast<std::uint8_t>(120.0 + 60.0 * std::sin(0.21 * u + 0.002 * u * v) +
                                   50.0 * std::cos(0.17 * v));
}

ColorImage Stacked(Stacking stacking, int disparity) {
  const bool vertical = stacking != Stacking::kHorizontal;
  ColorImage picture(vertical ? 80 : 160, vertical ? 120 : 60);
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 80; ++u) {
      const std::uint8_t left = Scene(u, v);
      const std::uint8_t right = Scene(u + disparity, v);
      switch (stacking) {
        case Stacking::kVertical:
          picture(u, v) = {left, left, left};
          picture(u, v + 60) = {right, right, right};
          break;
        case Stacking::kHorizontal:
          picture(u, v) = {left, left, left};
          picture(u + 80, v) = {right, right, right};
          break;
        case Stacking::kRows:
          picture(u, 2 * v) = {left, left, left};
          picture(u, 2 * v + 1) = {right, right, right};
          break;
      }
    }
  }
  return picture;
}

class Videos : public ::testing::Test {
 protected:
  void Write(const std::string& path, int num_frames) {
    auto video = CreateVideo(path, kWidth, kHeight, 25.0);
    ASSERT_TRUE(video.ok()) << video.status().message();
    for (int i = 0; i < num_frames; ++i) ASSERT_TRUE((*video)->Add(Plain(i)).ok());
    ASSERT_TRUE((*video)->Close().ok());
  }
  // Returns the brightness of a frame.
  int Grey(const std::string& path, int frame) {
    const StatusOr<ColorImage> picture = ReadVideoFrame(path, frame);
    if (!picture.ok()) {
      ADD_FAILURE() << picture.status().message();
      return -1;
    }
    return (*picture)(kWidth / 2, kHeight / 2)[1];
  }

  TemporaryDirectory folder_;
};

TEST_F(Videos, FramesAreTheSameInAnyOrder) {
  const std::string path = folder_ / "a.avi";
  Write(path, 12);
  for (const int frame : {0, 1, 1, 5, 11, 3, 0, 7}) {
    EXPECT_NEAR(Grey(path, frame), 10 * frame + 20, 2) << frame;
  }
}

TEST_F(Videos, TwoVideosAreReadInTurn) {
  Write(folder_ / "left.avi", 5);
  Write(folder_ / "right.avi", 5);
  for (int frame = 0; frame < 5; ++frame) {
    EXPECT_NEAR(Grey(folder_ / "left.avi", frame), 10 * frame + 20, 2);
    EXPECT_NEAR(Grey(folder_ / "right.avi", frame), 10 * frame + 20, 2);
  }
}

TEST_F(Videos, SizeLengthAndRateAreKnown) {
  for (const char* name : {"a.avi", "a.mp4"}) {
    Write(folder_ / name, 7);
    const StatusOr<VideoInfo> info = ReadVideoInfo(folder_ / name);
    ASSERT_TRUE(info.ok()) << info.status().message();
    EXPECT_EQ(info->width, kWidth);
    EXPECT_EQ(info->height, kHeight);
    EXPECT_EQ(info->num_frames, 7);
    EXPECT_EQ(info->frames_per_second, 25.0);
  }
}

TEST_F(Videos, WhatIsNoVideoIsAnError) {
  EXPECT_THAT(ReadVideoInfo(folder_ / "none.mp4").status().message(), HasSubstr("none.mp4"));
  WriteBytes(folder_ / "text.mp4", "no video");
  EXPECT_THAT(ReadVideoInfo(folder_ / "text.mp4").status().message(),
              HasSubstr("text.mp4: no video that can be read"));
  Write(folder_ / "a.avi", 3);
  EXPECT_THAT(ReadVideoFrame(folder_ / "a.avi", 3).status().message(),
              HasSubstr("a.avi: ends after 3 frames, expected frame 3"));
  EXPECT_EQ(Grey(folder_ / "a.avi", 2), 40);
}

TEST(VideoNames, EndingsDecide) {
  EXPECT_TRUE(IsVideoName("/a/b.MP4"));
  EXPECT_TRUE(IsVideoName("b.avi"));
  EXPECT_FALSE(IsVideoName("b.png"));
  EXPECT_FALSE(IsVideoName("mp4"));
}

TEST(StereoStacking, ContentDecidesWhereSizesAreUnknown) {
  for (const Stacking stacking : {Stacking::kVertical, Stacking::kHorizontal, Stacking::kRows}) {
    const StackingGuess guess = GuessStacking(Stacked(stacking, 9), 0, 0);
    EXPECT_EQ(guess.stacking, stacking) << guess.text;
    EXPECT_THAT(guess.text, HasSubstr("by the content of the first frame"));
  }
}

TEST(StereoStacking, SizeOfTheCalibrationDecides) {
  const ColorImage flat(80, 120, {9, 9, 9});
  EXPECT_EQ(GuessStacking(flat, 80, 60).text,
            "the left picture above the right one (by the calibration's size)");
  EXPECT_EQ(GuessStacking(flat, 40, 120).stacking, Stacking::kHorizontal);
}

}  // namespace
}  // namespace ceres_ed
