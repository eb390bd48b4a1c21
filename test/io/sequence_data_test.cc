// Tests on real sequences, whose folder is given by the environment variable CERES_ED_DATA.
#include "ceres_ed/io/sequence/depth_sequence.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Expected {
  const char* name;
  int num_frames;
  int width, height;
  double units_per_metre;
  bool has_poses;
  // The range of the median depth in the first frame, in metres.
  double nearest, farthest;
  // A part of the only warning; empty if there is none.
  const char* warning = "";
};

class RealSequences : public ::testing::TestWithParam<Expected> {};

TEST_P(RealSequences, AreReadAsTheyAre) {
  const Expected& expected = GetParam();
  const char* data = std::getenv("CERES_ED_DATA");
  if (data == nullptr) GTEST_SKIP() << "CERES_ED_DATA, the folder of real data, is not set";
  const std::string path = (std::filesystem::path(data) / expected.name).string();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";

  const auto sequence = OpenSequence(path);
  ASSERT_TRUE(sequence.ok()) << sequence.status().message();
  if (*expected.warning == 0) {
    EXPECT_THAT((*sequence)->warnings(), IsEmpty());
  } else {
    EXPECT_THAT((*sequence)->warnings(), ElementsAre(HasSubstr(expected.warning)));
  }
  ASSERT_EQ((*sequence)->num_frames(), expected.num_frames);
  EXPECT_EQ((*sequence)->depth_units_per_metre(), expected.units_per_metre);
  EXPECT_TRUE((*sequence)->has_color());
  for (int i = 0; i < expected.num_frames; ++i) {
    EXPECT_EQ((*sequence)->frame_number(i), i);
    EXPECT_EQ((*sequence)->given_pose(i) != nullptr, expected.has_poses);
  }
  const StatusOr<DepthFrame> frame = (*sequence)->Load(expected.num_frames - 1);
  ASSERT_TRUE(frame.ok()) << frame.status().message();
  EXPECT_EQ(frame->depth.width(), expected.width);
  EXPECT_EQ(frame->depth.height(), expected.height);
  EXPECT_EQ(frame->color.width(), expected.width);
  EXPECT_EQ(DepthRangeWarning(frame->depth, expected.units_per_metre), "");
  std::vector<float> measured;
  for (const float depth : frame->depth.pixels()) {
    if (depth > 0.0F) measured.push_back(depth);
  }
  ASSERT_FALSE(measured.empty());
  std::sort(measured.begin(), measured.end());
  EXPECT_GT(measured[measured.size() / 2], expected.nearest);
  EXPECT_LT(measured[measured.size() / 2], expected.farthest);
}

INSTANTIATE_TEST_SUITE_P(
    All,
    RealSequences,
    ::testing::Values(Expected{"liver_breath_render", 60, 640, 480, 1e4, true, 0.1, 1.0},
                      Expected{"invivo_heart_40", 40, 360, 288, 1e5, false, 0.01, 0.05},
                      // Its masks show a toy, which is small in the picture.
                      Expected{"snoopy_a", 2, 640, 480, 1e3, false, 0.3, 3.0, "masks: they leave"},
                      Expected{"shirt_nogt", 2, 640, 480, 1e3, false, 0.3, 5.0}),
    [](const ::testing::TestParamInfo<Expected>& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace ceres_ed
