#include "ceres_ed/slam/frame/motion_information.h"

#include <cmath>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>

namespace ceres_ed {
namespace {

MotionInformation Around(const Eigen::Vector3d& center, double radius) {
  MotionInformation information;
  information.center = center;
  information.radius = radius;
  information.strengths.setOnes();
  return information;
}

TEST(MotionInformation, CoordinatesAreTheMotionOfPointsAtTheRadius) {
  const MotionInformation information = Around({0.3, -0.2, 5.0}, 2.0);
  const CameraPose motion = Motion(0.01, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0});
  const Vector6d x = information.CoordinatesOf(motion);
  EXPECT_NEAR(x[2], 0.02, 1e-15);
  EXPECT_NEAR(x.head<2>().norm(), 0.0, 1e-15);
  // The centre itself moves by the cross product of the turn and its position.
  EXPECT_LT((x.tail<3>() - (motion * information.center - information.center)).norm(), 1e-15);
}

TEST(MotionInformation, MotionOfTakesCoordinatesBack) {
  const MotionInformation information = Around({0.3, -0.2, 5.0}, 2.0);
  const CameraPose motion = Motion(0.7, {0.2, -1.0, 0.4}, {0.3, -0.2, 0.1});
  const CameraPose again = information.MotionOf(information.CoordinatesOf(motion));
  EXPECT_LT(again.rotation.angularDistance(motion.rotation), 1e-12);
  EXPECT_LT((again.translation - motion.translation).norm(), 1e-12);
}

TEST(MotionInformation, HalfOfADirectionIsBelievedAtTheFloor) {
  MotionInformation information = Around({0.0, 0.0, 5.0}, 1.0);
  information.noise = 0.02;
  information.floor = 0.01;
  information.strengths << 0.0, 0.02, 0.0300001, 0.05, 0.5, 1.0;
  EXPECT_EQ(information.Determined(0), 0.0);
  EXPECT_EQ(information.Determined(1), 0.0);
  EXPECT_NEAR(information.Determined(2), 0.5, 1e-4);
  EXPECT_NEAR(information.Determined(3), 0.9, 1e-12);
  EXPECT_GT(information.Determined(5), 0.9998);
  EXPECT_EQ(information.NumWeak(), 2);
}

TEST(MotionInformation, DeterminedPartLeavesOutWhatTheDataDoNotSay) {
  MotionInformation information = Around({0.0, 0.0, 5.0}, 1.0);
  information.floor = 1e-9;
  // Nothing is known about the rotation about z.
  information.strengths << 1.0, 1.0, 0.0, 1.0, 1.0, 1.0;
  const CameraPose motion = information.MotionOf((Vector6d() << 0.1, 0, 0.2, 0.3, 0, 0).finished());
  const Vector6d kept = information.CoordinatesOf(information.DeterminedPart(motion));
  EXPECT_LT((kept - (Vector6d() << 0.1, 0, 0, 0.3, 0, 0).finished()).norm(), 1e-9);
}

}  // namespace
}  // namespace ceres_ed
