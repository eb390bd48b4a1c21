#include "small_fit.h"

#include <ceres_ed/report/view/warp_motion.h>

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

std::vector<int> All(const SmallFit& fit) {
  std::vector<int> all(fit.source.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

WarpMotion MotionOf(const SmallFit& fit) {
  return MakeWarpMotion(fit.warp, fit.skinning, fit.source.points, All(fit));
}

TEST(WarpMotion, BeginsAtTheSourceAndEndsAtTheWarp) {
  const SmallFit fit = MakeSmallFit();
  const WarpMotion motion = MotionOf(fit);
  for (int i = 0; i < static_cast<int>(fit.source.size()); ++i) {
    const Eigen::Vector3d& point = fit.source.points[i];
    EXPECT_LT((motion.Move(point, i, {0.0, 0.0}) - point).norm(), 1e-12);
    EXPECT_LT((motion.Move(point, i, {1.0, 1.0}) - fit.result[i]).norm(), 1e-12);
  }
}

TEST(WarpMotion, IsTheRigidPlacementBeforeAnythingBends) {
  const SmallFit fit = MakeSmallFit();
  const WarpMotion motion = MotionOf(fit);
  const Eigen::Vector3d& point = fit.source.points[7];
  EXPECT_LT((motion.Move(point, 7, {1.0, 0.0}) - fit.warp.target_from_source * point).norm(),
            1e-12);
}

// Half of the way is the warp whose nodes have made half of their motions.
TEST(WarpMotion, InBetweenIsAWarpItself) {
  SmallFit fit = MakeSmallFit();
  const WarpMotion motion = MotionOf(fit);
  constexpr double kPart = 0.4;
  for (int j = 0; j < 5; ++j) {
    // The factors of small_fit.h.
    const Eigen::AngleAxisd turn(kPart * (0.2 * j - 0.3),
                                 Eigen::Vector3d(0.3, 1.0, 0.1 * j).normalized());
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
    stretch(0, 0) += kPart * 0.05 * j;
    stretch(0, 1) = stretch(1, 0) = kPart * 0.02 * j;
    MutableNodeAffine(fit.warp.state.node(j)) = turn.toRotationMatrix() * stretch;
    MutableNodeTranslation(fit.warp.state.node(j)) *= kPart;
  }
  for (Eigen::Vector3d& displacement : fit.warp.finish.displacements) displacement *= kPart;
  PointCloud expected = fit.source;
  ASSERT_TRUE(ApplyWarp(fit.warp, fit.skinning, &expected).ok());
  for (int i = 0; i < static_cast<int>(fit.source.size()); ++i) {
    EXPECT_LT((motion.Move(fit.source.points[i], i, {1.0, kPart}) - expected.points[i]).norm(),
              1e-12);
  }
}

TEST(WarpMotion, ThePlacementTurnsAboutTheCentre) {
  const SmallFit fit = MakeSmallFit();
  const WarpMotion motion = MotionOf(fit);
  EXPECT_LT((motion.center - Eigen::Vector3d(0.5, 0.5, 0.0)).norm(), 1e-12);
  const auto place = [&](const Eigen::Vector3d& point) {
    WarpMotion only = motion;
    only.stride = 0;
    only.nodes.clear();
    only.finish.clear();
    return only.Move(point, 0, {0.5, 0.0});
  };
  const Eigen::Vector3d end = fit.warp.target_from_source * motion.center;
  EXPECT_LT((place(motion.center) - 0.5 * (motion.center + end)).norm(), 1e-12);
  // Half of the scale is its root.
  const Eigen::Vector3d aside = motion.center + Eigen::Vector3d::UnitX();
  EXPECT_NEAR((place(aside) - place(motion.center)).norm(), std::sqrt(1.3), 1e-12);
}

TEST(WarpMotion, APlacementThatIsNotSeenTakesNoPartOfTheWay) {
  SmallFit fit = MakeSmallFit();
  EXPECT_GT(MotionOf(fit).PlacementShare(fit.source.points, 1.4), 0.0);
  fit.warp.target_from_source = Similarity();
  EXPECT_EQ(MotionOf(fit).PlacementShare(fit.source.points, 1.4), 0.0);
  EXPECT_EQ(PartsAt(0.3, 0.0).placed, 1.0);
  EXPECT_EQ(PartsAt(0.3, 0.0).bent, 0.3);
  EXPECT_EQ(PartsAt(0.2, 0.4).placed, 0.5);
  EXPECT_EQ(PartsAt(0.2, 0.4).bent, 0.0);
  EXPECT_EQ(PartsAt(1.0, 0.4).bent, 1.0);
}

TEST(WarpMotion, ANodeThatIsTurnedInsideOutStillReachesItsEnd) {
  SmallFit fit = MakeSmallFit();
  MutableNodeAffine(fit.warp.state.node(4)).col(2) *= -1.0;
  PointCloud expected = fit.source;
  ASSERT_TRUE(ApplyWarp(fit.warp, fit.skinning, &expected).ok());
  const WarpMotion motion = MotionOf(fit);
  for (int i = 0; i < static_cast<int>(fit.source.size()); ++i) {
    EXPECT_LT((motion.Move(fit.source.points[i], i, {1.0, 1.0}) - expected.points[i]).norm(),
              1e-12);
  }
}

TEST(StraightMotion, GoesAlongLines) {
  const std::vector<Eigen::Vector3d> from = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  const std::vector<Eigen::Vector3d> to = {{0.0, 2.0, 0.0}, {3.0, 0.0, 4.0}};
  const WarpMotion motion = StraightMotion(from, to);
  EXPECT_EQ(motion.Move(from[1], 1, {1.0, 0.5}), Eigen::Vector3d(2.0, 0.0, 2.0));
}

}  // namespace
}  // namespace ceres_ed
