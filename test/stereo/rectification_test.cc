#include "ceres_ed/stereo/rectification.h"

#include "stereo_scenes.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

std::string ErrorOf(const StereoRig& rig, bool is_rectified) {
  const auto made = Rectification::Create(rig, is_rectified);
  return made.ok() ? "no error" : made.status().message();
}

TEST(Rectification, OfRectifiedPicturesChangesNothing) {
  const auto made = Rectification::Create(RectifiedTestRig(), true);
  ASSERT_TRUE(made.ok()) << made.status().message();
  EXPECT_EQ((*made)->rig().baseline, 0.005);
  EXPECT_EQ((*made)->rig().offset, 3.0);
  ColorImage picture(320, 240, {1, 2, 3});
  const RectifiedPair pair = (*made)->Apply(picture, picture, {});
  EXPECT_EQ(pair.left.pixels(), picture.pixels());
  EXPECT_EQ(pair.left_mask(0, 0), 255);
}

// The rectified right camera sees the point of pixel (u, v) of the left one in the same row, at the
// disparity f b / z + offset: the pictures of both cameras agree there.
TEST(Rectification, OfATurnedRigMakesRowsCorrespond) {
  const StereoRig rig = TurnedTestRig();
  const auto made = Rectification::Create(rig, false);
  ASSERT_TRUE(made.ok()) << made.status().message();
  const RectifiedRig& rectified = (*made)->rig();
  EXPECT_NEAR(rectified.baseline, rig.right_from_left.translation.norm(), 1e-12);
  const std::vector<TexturedPlane> planes = {{Eigen::Vector3d(0.1, 0.2, 1.0).normalized(), 0.06}};
  const RectifiedPair pair =
      (*made)->Apply(Photograph(planes, rig.left.pinhole, {}),
                     Photograph(planes, rig.right.pinhole, rig.right_from_left),
                     {});
  const RigidTransform left_from_rectified = rectified.rectified_from_left.Inverse();
  double sum = 0.0;
  int count = 0;
  for (int v = 10; v < 230; ++v) {
    for (int u = 60; u < 310; ++u) {
      Eigen::Vector3d point;
      const Eigen::Vector3d ray =
          left_from_rectified.rotation * rectified.camera.BackProject(u, v, 1.0);
      ASSERT_TRUE(Hit(planes, Eigen::Vector3d::Zero(), ray, &point));
      const double z = (rectified.rectified_from_left * point).z();
      const double match = u - rectified.FocalTimesBaseline() / z - rectified.offset;
      const int left = static_cast<int>(std::floor(match));
      if (left < 0 || left + 1 >= 320 || pair.left_mask(u, v) == 0 ||
          pair.right_mask(left, v) == 0 || pair.right_mask(left + 1, v) == 0) {
        continue;
      }
      const double share = match - left;
      sum += std::abs(pair.left(u, v)[1] - (1.0 - share) * pair.right(left, v)[1] -
                      share * pair.right(left + 1, v)[1]);
      ++count;
    }
  }
  EXPECT_GT(count, 30000);
  // Neighbouring rows differ by much more.
  EXPECT_LT(sum / count, 2.5);
}

TEST(Rectification, RefusesATransformThatIsTheOtherWayRound) {
  StereoRig rig = TurnedTestRig();
  rig.right_from_left = rig.right_from_left.Inverse();
  EXPECT_THAT(ErrorOf(rig, false), HasSubstr("the transform is the other way round"));
}

TEST(Rectification, RefusesCamerasThatAreNotSideBySide) {
  StereoRig rig = RectifiedTestRig();
  rig.right_from_left.translation = {0.0, -0.005, 0.0};
  EXPECT_THAT(ErrorOf(rig, false), HasSubstr("the cameras must stand side by side"));
  rig.right_from_left.translation.setZero();
  EXPECT_THAT(ErrorOf(rig, false), HasSubstr("expected a baseline"));
}

TEST(Rectification, RefusesATurnedRigThatIsSaidToBeRectified) {
  EXPECT_THAT(ErrorOf(TurnedTestRig(), true), HasSubstr("not that of rectified pictures"));
}

TEST(Rectification, RefusesNumbersThatAreNotFinite) {
  StereoRig rig = TurnedTestRig();
  rig.left.distortion[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(ErrorOf(rig, false), HasSubstr("the distortion of the left camera"));
  rig = TurnedTestRig();
  rig.right.pinhole.fx = -1.0;
  EXPECT_THAT(ErrorOf(rig, false), HasSubstr("the calibration of the right camera"));
}

}  // namespace
}  // namespace ceres_ed
