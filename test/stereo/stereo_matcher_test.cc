#include "ceres_ed/stereo/stereo_matcher.h"

#include "stereo_scenes.h"

#include <ceres_ed/util/options.h>
#include <ceres_ed/util/statistics.h>

#include <cstddef>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>
#include <test/util/option_members.h>

namespace ceres_ed {
namespace {

StereoDepth MatchPlanes(const std::vector<TexturedPlane>& planes,
                        const StereoRig& rig,
                        bool is_rectified,
                        const StereoOptions& options = {},
                        const MaskImage& mask = {}) {
  const auto matcher = StereoMatcher::Create(rig, is_rectified, options);
  EXPECT_TRUE(matcher.ok()) << matcher.status().message();
  return (*matcher)->Match(Photograph(planes, rig.left.pinhole, {}),
                           Photograph(planes, rig.right.pinhole, rig.right_from_left),
                           mask);
}

// Returns the disparity of the depth minus that of the planes, at each pixel with depth.
std::vector<double> DisparityErrors(const StereoDepth& found,
                                    const std::vector<TexturedPlane>& planes,
                                    const RectifiedRig& rig) {
  const Eigen::Quaterniond left_from_rectified = rig.rectified_from_left.rotation.conjugate();
  std::vector<double> errors;
  for (int v = 0; v < found.depth.height(); ++v) {
    for (int u = 0; u < found.depth.width(); ++u) {
      if (found.depth(u, v) == 0.0F) continue;
      Eigen::Vector3d point;
      const Eigen::Vector3d ray = left_from_rectified * rig.camera.BackProject(u, v, 1.0);
      if (!Hit(planes, Eigen::Vector3d::Zero(), ray, &point)) continue;
      const double z = (rig.rectified_from_left * point).z();
      errors.push_back(rig.FocalTimesBaseline() * (1.0 / found.depth(u, v) - 1.0 / z));
    }
  }
  return errors;
}

const std::vector<TexturedPlane> kSlanted = {{Eigen::Vector3d(0.2, 0.1, 1.0).normalized(), 0.055}};

class EveryMode : public ::testing::TestWithParam<StereoMode> {};

TEST_P(EveryMode, FindsTheDepthOfASlantedPlane) {
  StereoOptions options;
  options.mode = GetParam();
  const StereoDepth found = MatchPlanes(kSlanted, RectifiedTestRig(), true, options);
  EXPECT_GT(found.valid_share, 0.85);
  const auto rig = Rectification::Create(RectifiedTestRig(), true);
  const std::vector<double> errors = DisparityErrors(found, kSlanted, (*rig)->rig());
  EXPECT_LT(std::abs(Median(errors)), 0.02);
  EXPECT_LT(RobustDeviation(errors), 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    OfMatching,
    EveryMode,
    ::testing::Values(StereoMode::kThreeWay, StereoMode::kSgbm, StereoMode::kHh4, StereoMode::kHh));

TEST(StereoMatcher, FindsDepthThroughATurnedCamera) {
  const StereoRig rig = TurnedTestRig();
  const StereoDepth found = MatchPlanes(kSlanted, rig, false);
  const auto rectification = Rectification::Create(rig, false);
  const std::vector<double> errors = DisparityErrors(found, kSlanted, (*rectification)->rig());
  EXPECT_GT(errors.size(), 40000u);
  EXPECT_LT(std::abs(Median(errors)), 0.03);
  EXPECT_LT(RobustDeviation(errors), 0.12);
}

TEST(StereoMatcher, FindsTheSameDepthInSmallerPictures) {
  StereoOptions options;
  options.reduce = 2;
  const StereoDepth found = MatchPlanes(kSlanted, RectifiedTestRig(), true, options);
  const auto rig = Rectification::Create(RectifiedTestRig(), true);
  const std::vector<double> errors = DisparityErrors(found, kSlanted, (*rig)->rig());
  EXPECT_LT(std::abs(Median(errors)), 0.05);
  EXPECT_LT(RobustDeviation(errors), 0.25);
}

// A near plane hides a part of the far one from the right camera.
TEST(StereoMatcher, LeavesOutWhatOnlyTheLeftCameraSees) {
  TexturedPlane far, near;
  far.distance = 0.08;
  near.distance = 0.04;
  near.first = 0.0;
  const StereoRig rig = RectifiedTestRig();
  const StereoDepth found = MatchPlanes({far, near}, rig, true);
  // Left of the edge at u = cx, by f b (1 / 0.04 - 1 / 0.08) = 17.5 pixels.
  int hidden = 0, wrong = 0;
  for (int v = 20; v < 220; ++v) {
    for (int u = 145; u < 158; ++u) {
      ++hidden;
      wrong += found.depth(u, v) > 0.0F ? 1 : 0;
    }
  }
  EXPECT_LT(wrong, 0.05 * hidden);
  EXPECT_NEAR(found.depth(100, 120), 0.08F, 0.001F);
  EXPECT_NEAR(found.depth(240, 120), 0.04F, 0.0005F);
}

TEST(StereoMatcher, LeavesOutHighlightsAndTheMask) {
  const StereoRig rig = RectifiedTestRig();
  const auto matcher = StereoMatcher::Create(rig, true, {});
  ColorImage left = Photograph(kSlanted, rig.left.pinhole, {});
  const ColorImage right = Photograph(kSlanted, rig.right.pinhole, rig.right_from_left);
  for (int v = 100; v < 110; ++v) {
    for (int u = 200; u < 210; ++u) left(u, v) = {255, 255, 255};
  }
  MaskImage mask(320, 240, 1);
  for (int u = 150; u < 320; ++u) mask(u, 50) = 0;
  const StereoDepth found = (*matcher)->Match(left, right, mask);
  for (int k = 0; k < 10; ++k) EXPECT_EQ(found.depth(200 + k, 100 + k), 0.0F);
  for (int u = 150; u < 320; ++u) EXPECT_EQ(found.depth(u, 50), 0.0F);
  EXPECT_GT(found.depth(250, 150), 0.0F);
}

// A word at the same place of both pictures is at infinity.
TEST(StereoMatcher, LeavesOutBurnedInText) {
  const StereoRig rig = MakeRectifiedRig({280.0, 280.0, 160.0, 119.5, 320, 240}, 160.0, 0.005);
  const auto matcher = StereoMatcher::Create(rig, true, {});
  ColorImage left = Photograph(kSlanted, rig.left.pinhole, {});
  ColorImage right = Photograph(kSlanted, rig.right.pinhole, rig.right_from_left);
  for (int v = 20; v < 40; ++v) {
    for (int u = 200; u < 260; ++u) {
      const std::uint8_t level = (u / 3 * 37 + v / 4 * 101) % 59 % 2 == 0 ? 220 : 20;
      left(u, v) = right(u, v) = {level, level, level};
    }
  }
  const StereoDepth found = (*matcher)->Match(left, right, {});
  int with_depth = 0;
  for (int v = 22; v < 38; ++v) {
    for (int u = 204; u < 256; ++u) with_depth += found.depth(u, v) > 0.0F ? 1 : 0;
  }
  EXPECT_LT(with_depth, 0.3 * 16 * 52);
  for (const float z : found.depth.pixels()) EXPECT_LT(z, 0.2F);
}

TEST(StereoMatcher, GivesNoDepthInTheDark) {
  const StereoRig rig = RectifiedTestRig();
  const auto matcher = StereoMatcher::Create(rig, true, {});
  const ColorImage dark(320, 240, {3, 3, 3});
  EXPECT_EQ((*matcher)->Match(dark, dark, {}).valid_share, 0.0);
}

TEST(StereoMatcher, GivesTheSameBytesAtAnyNumberOfThreads) {
  const int before = cv::getNumThreads();
  for (const NamedValue<StereoMode>& mode : NamesOf(StereoMode())) {
    StereoOptions options;
    options.mode = mode.value;
    cv::setNumThreads(1);
    const StereoDepth one = MatchPlanes(kSlanted, TurnedTestRig(), false, options);
    cv::setNumThreads(4);
    const StereoDepth four = MatchPlanes(kSlanted, TurnedTestRig(), false, options);
    EXPECT_EQ(one.depth.pixels(), four.depth.pixels()) << mode.name;
  }
  cv::setNumThreads(before);
}

TEST(StereoMatcher, StatesTheNoiseOfItsDepth) {
  StereoOptions options;
  options.disparity_sigma = 0.2;
  const auto matcher = StereoMatcher::Create(RectifiedTestRig(), true, options);
  // z^2 / (f b) sigma_d.
  EXPECT_DOUBLE_EQ((*matcher)->noise().At(0.05), 0.05 * 0.05 / (280.0 * 0.005) * 0.2);
}

TEST(StereoMatcher, FindsDepthInTinyPictures) {
  for (const int width : {1, 2, 5, 17}) {
    const StereoRig rig =
        MakeRectifiedRig({10.0, 10.0, 0.5 * width, 1.0, width, 3}, 0.5 * width, 0.005);
    for (const int reduce : {0, 4}) {
      StereoOptions options;
      options.reduce = reduce;
      const auto matcher = StereoMatcher::Create(rig, true, options);
      ASSERT_TRUE(matcher.ok());
      const ColorImage picture(width, 3, {100, 100, 100});
      EXPECT_EQ((*matcher)->Match(picture, picture, {}).depth.width(), width);
    }
  }
}

TEST(StereoOptions, HasARowForEachMember) {
  EXPECT_EQ(StereoOptions::Rows().num_members(), CountMembers<StereoOptions>());
}

TEST(StereoOptions, RefusesValuesOutOfRange) {
  std::string error;
  StereoOptions options;
  EXPECT_TRUE(options.IsValid(&error));
  options.window = 4;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_EQ(error, "window is 4, expected an odd number of pixels");
  options = {};
  options.reduce = 3;
  EXPECT_FALSE(options.IsValid(&error));
  options = {};
  options.max_disparity = 10;
  options.min_disparity = 20;
  EXPECT_FALSE(options.IsValid(&error));
}

}  // namespace
}  // namespace ceres_ed
