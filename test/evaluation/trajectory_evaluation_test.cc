#include "ceres_ed/evaluation/trajectory_evaluation.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
constexpr int kFrames = 10;

Eigen::Quaterniond Turn(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kRadiansPerDegree, axis.normalized()));
}

// Returns a helix with a camera that rotates.
std::map<int, CameraPose> Helix() {
  std::map<int, CameraPose> poses;
  for (int f = 0; f < kFrames; ++f) {
    poses[f].rotation = Turn(5.0 * f, {1, 2, 3});
    poses[f].translation = {std::cos(0.3 * f), std::sin(0.3 * f), 0.1 * f};
  }
  return poses;
}

// Returns the same trajectory in another world frame.
std::map<int, CameraPose> Moved(std::map<int, CameraPose> poses) {
  const Eigen::Quaterniond rotation = Turn(70.0, {3, -1, 2});
  for (auto& [frame, pose] : poses) {
    pose.translation = rotation * pose.translation + Eigen::Vector3d(1.0, -2.0, 0.5);
    pose.rotation = rotation * pose.rotation;
  }
  return poses;
}

TEST(EvaluateTrajectory, FindsNoErrorInAnotherWorld) {
  const auto evaluation = EvaluateTrajectory(Moved(Helix()), Helix());
  ASSERT_TRUE(evaluation.ok());
  for (const TrajectoryError* error :
       {&evaluation->from_first_frame, &evaluation->best_alignment}) {
    EXPECT_EQ(error->frames.size(), 10u);
    EXPECT_NEAR(error->translation_rmse, 0.0, 1e-12);
    EXPECT_NEAR(error->translation_max, 0.0, 1e-12);
    // An angle computed from a cosine near 1 has half the digits.
    EXPECT_NEAR(error->rotation_max_deg, 0.0, 1e-5);
  }
}

TEST(EvaluateTrajectory, CountsAnOffsetSinceTheFirstFrameInFull) {
  std::map<int, CameraPose> estimate = Helix();
  for (int f = 1; f < kFrames; ++f) {
    estimate[f].translation += Eigen::Vector3d(0.03, 0.0, 0.04);
    estimate[f].rotation = estimate[f].rotation * Turn(2.0, {0, 1, 0});
  }
  const auto evaluation = EvaluateTrajectory(Moved(estimate), Helix());
  ASSERT_TRUE(evaluation.ok());
  const TrajectoryError& error = evaluation->from_first_frame;
  EXPECT_NEAR(error.frames[0].translation, 0.0, 1e-12);
  EXPECT_NEAR(error.frames[7].translation, 0.05, 1e-12);
  EXPECT_NEAR(error.frames[7].rotation_deg, 2.0, 1e-6);
  EXPECT_NEAR(error.translation_rmse, 0.05 * std::sqrt(0.9), 1e-12);
  EXPECT_NEAR(error.translation_mean, 0.05 * 0.9, 1e-12);
  EXPECT_NEAR(error.translation_median, 0.05, 1e-12);
  EXPECT_NEAR(error.rotation_mean_deg, 1.8, 1e-6);
  // The best alignment removes most of the error, and cannot be worse in the sum of squares.
  EXPECT_LT(evaluation->best_alignment.translation_rmse, 0.5 * error.translation_rmse);
  EXPECT_GT(evaluation->best_alignment.translation_rmse, 0.0);
}

TEST(EvaluateTrajectory, AlignsAStraightPathByItsOrientations) {
  std::map<int, CameraPose> truth;
  for (int f = 0; f < kFrames; ++f) {
    truth[f].translation = {0.1 * f, 0.0, 0.0};
    truth[f].rotation = Turn(3.0 * f, {1, 0, 0});
  }
  const auto evaluation = EvaluateTrajectory(Moved(truth), truth);
  ASSERT_TRUE(evaluation.ok());
  EXPECT_NEAR(evaluation->best_alignment.translation_rmse, 0.0, 1e-12);
  EXPECT_NEAR(evaluation->best_alignment.rotation_max_deg, 0.0, 1e-5);
}

TEST(EvaluateTrajectory, ComparesTheFramesThatBothHave) {
  std::map<int, CameraPose> estimate = Moved(Helix());
  estimate.erase(0);
  estimate.erase(5);
  estimate[77] = CameraPose();
  const auto evaluation = EvaluateTrajectory(estimate, Helix());
  ASSERT_TRUE(evaluation.ok());
  EXPECT_EQ(evaluation->from_first_frame.frames.size(), 8u);
  EXPECT_EQ(evaluation->from_first_frame.frames[0].frame, 1);
  EXPECT_NEAR(evaluation->from_first_frame.translation_max, 0.0, 1e-12);
  EXPECT_THAT(EvaluateTrajectory({{77, CameraPose()}}, Helix()).status().message(),
              HasSubstr("no frame is in both"));
}

}  // namespace
}  // namespace ceres_ed
