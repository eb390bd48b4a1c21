#include "ceres_ed/geometry/rigid_transform.h"

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

RigidTransform Turn(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& translation) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())), translation};
}

const Eigen::Vector3d kPoint(0.3, -2.0, 5.0);

TEST(RigidTransform, IsTheIdentityByDefault) { EXPECT_EQ(RigidTransform() * kPoint, kPoint); }

TEST(RigidTransform, TurnsThenMoves) {
  const RigidTransform transform = Turn(M_PI / 2.0, {0, 0, 1}, {10, 20, 30});
  EXPECT_LT((transform * kPoint - Eigen::Vector3d(12.0, 20.3, 35.0)).norm(), 1e-14);
}

TEST(RigidTransform, OfAProductActsAsBothInTurn) {
  const RigidTransform c_from_b = Turn(0.7, {1, 2, 3}, {1, 0, -1});
  const RigidTransform b_from_a = Turn(-1.9, {0, 1, -1}, {0, 5, 2});
  EXPECT_LT((c_from_b * b_from_a * kPoint - c_from_b * (b_from_a * kPoint)).norm(), 1e-14);
}

TEST(RigidTransform, IsTakenBackByItsInverse) {
  const RigidTransform transform = Turn(2.5, {1, -2, 0.5}, {3, 2, 1});
  EXPECT_LT((transform.Inverse() * (transform * kPoint) - kPoint).norm(), 1e-14);
  EXPECT_LT((transform.ApplyInverse(transform * kPoint) - kPoint).norm(), 1e-14);
}

}  // namespace
}  // namespace ceres_ed
