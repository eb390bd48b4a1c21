#include "ceres_ed/stereo/disparity.h"

#include "stereo_scenes.h"

#include <ceres_ed/stereo/stereo_matcher.h>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

TEST(FindRange, HoldsTheDisparitiesOfThePlanes) {
  TexturedPlane far, near;
  far.distance = 0.08;
  near.distance = 0.04;
  near.first = 0.0;
  const StereoRig rig = RectifiedTestRig();
  const GrayImage left = GrayOf(Photograph({far, near}, rig.left.pinhole, {}));
  const GrayImage right = GrayOf(Photograph({far, near}, rig.right.pinhole, rig.right_from_left));
  const DisparityRange range = FindRange(left, right, MaskImage(320, 240, 1), 3.0);
  // f b / z + offset: 20.5 and 38.
  EXPECT_LT(range.min, 20);
  EXPECT_GT(range.min, 5);
  EXPECT_GT(range.min + range.count, 39);
  EXPECT_LT(range.min + range.count, 60);
}

TEST(FindRange, IsEmptyWithoutTexture) {
  const GrayImage even(320, 240, 90);
  EXPECT_EQ(FindRange(even, even, MaskImage(320, 240, 1), 0.0).count, 0);
}

TEST(LeaveOutEdges, KeepsSmallHolesAndDropsJumps) {
  DisparityImage disparity(60, 40, 10.0F);
  disparity(10, 20) = kNoDisparity;
  for (int v = 0; v < 40; ++v) {
    for (int u = 40; u < 60; ++u) disparity(u, v) = 20.0F;
  }
  LeaveOutEdges(3, &disparity);
  EXPECT_EQ(disparity(11, 20), 10.0F);
  EXPECT_EQ(disparity(38, 20), kNoDisparity);
  EXPECT_EQ(disparity(41, 20), kNoDisparity);
  EXPECT_EQ(disparity(30, 20), 10.0F);
  EXPECT_EQ(disparity(50, 20), 20.0F);
}

TEST(DoubleSize, KeepsAnAffineDisparity) {
  DisparityImage half(20, 10);
  for (int v = 0; v < 10; ++v) {
    for (int u = 0; u < 20; ++u) half(u, v) = 5.0F + 0.1F * static_cast<float>(u);
  }
  const DisparityImage full = DoubleSize(half, 41, 21);
  // Column u of the full picture is at u / 2 - 1 / 4 in the half one.
  for (int u = 2; u < 38; ++u) EXPECT_NEAR(full(u, 9), 2.0 * (5.0 + 0.1 * (0.5 * u - 0.25)), 1e-4);
}

TEST(SmoothDisparity, KeepsEdgesAndHoles) {
  DisparityImage disparity(40, 20, 10.0F);
  for (int v = 0; v < 20; ++v) {
    for (int u = 20; u < 40; ++u) disparity(u, v) = 30.0F;
  }
  disparity(10, 10) = kNoDisparity;
  SmoothDisparity(5, &disparity);
  EXPECT_EQ(disparity(10, 10), kNoDisparity);
  EXPECT_NEAR(disparity(19, 10), 10.0F, 1e-3F);
  EXPECT_NEAR(disparity(20, 10), 30.0F, 1e-3F);
}

}  // namespace
}  // namespace ceres_ed
