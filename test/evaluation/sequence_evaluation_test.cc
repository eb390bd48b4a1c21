#include "ceres_ed/evaluation/sequence_evaluation.h"

#include <ceres_ed/evaluation/sequence_figures.h>

#include <cmath>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

// The motion of the plane and of the camera per frame, in the world frame.
const Eigen::Vector3d kTissueStep(0.02, -0.01, 0.005);
const Eigen::Vector3d kCameraStep(0.01, 0.02, -0.02);
constexpr int kFrames = 4;

// Returns a camera that sees x and y from -1 to 1 at z = 1.
PinholeCamera MakeCamera() { return {50.0, 50.0, 49.5, 49.5, 100, 100}; }

// Returns a plane z = 1 of 2 x 2 squares that moves without rotation, under a camera that moves
// likewise.
SceneTruth MovingPlane() {
  SceneTruth truth;
  truth.triangles = {
      {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}, {4, 5, 8}, {4, 8, 7}};
  truth.num_vertices = 9;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (const double y : {-2.0, 0.0, 2.0}) {
      for (const double x : {-2.0, 0.0, 2.0}) {
        const Eigen::Vector3d vertex = Eigen::Vector3d(x, y, 1.0) + frame * kTissueStep;
        for (int axis = 0; axis < 3; ++axis) {
          truth.vertices.push_back(static_cast<float>(vertex[axis]));
        }
      }
    }
    truth.world_from_camera[frame].translation = frame * kCameraStep;
  }
  return truth;
}

// The rounding error of float vertices and of sums.
constexpr double kRound = 1e-6;

// Returns the map of a perfect run in the camera frame of `frame`: a grid of points created in
// frame `born`.
LiveSnapshot PerfectMap(int frame, int born = 0) {
  LiveSnapshot snapshot;
  snapshot.frame = frame;
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      const Eigen::Vector3d place(0.1 * i + 0.013, 0.1 * j - 0.007, 1.0);
      const Eigen::Vector3d step = kTissueStep - kCameraStep;
      snapshot.points.push_back(place + frame * step);
      snapshot.birth_points.push_back(place + born * step);
      snapshot.ids.push_back(1000 * born + static_cast<int>(snapshot.ids.size()));
      snapshot.birth_frames.push_back(born);
    }
  }
  return snapshot;
}

void Shift(const Eigen::Vector3d& by, LiveSnapshot* snapshot) {
  for (Eigen::Vector3d& point : snapshot->points) point += by;
}

FrameTruthError Evaluate(const LiveSnapshot& snapshot) {
  const SceneTruth truth = MovingPlane();
  TruthEvaluator evaluator(MakeCamera(), truth);
  const StatusOr<FrameTruthError> error = evaluator.Evaluate(snapshot);
  EXPECT_TRUE(error.ok()) << error.status().message();
  return error.ok() ? *error : FrameTruthError();
}

TEST(TruthEvaluator, FindsNoErrorInAPerfectMap) {
  for (int frame = 0; frame < kFrames; ++frame) {
    for (int born = 0; born <= frame; ++born) {
      const FrameTruthError error = Evaluate(PerfectMap(frame, born));
      EXPECT_EQ(error.frame, frame);
      EXPECT_EQ(error.points, 81);
      EXPECT_EQ(error.seen, 81);
      EXPECT_EQ(error.unknown, 0);
      EXPECT_NEAR(error.surface_all->max, 0.0, kRound);
      EXPECT_NEAR(error.tracking_seen->max, 0.0, kRound);
      EXPECT_FALSE(error.tracking_hidden);
    }
  }
}

TEST(TruthEvaluator, MeasuresAnOffsetAlongTheNormal) {
  LiveSnapshot snapshot = PerfectMap(2);
  Shift({0.0, 0.0, -0.004}, &snapshot);
  const FrameTruthError error = Evaluate(snapshot);
  EXPECT_NEAR(error.surface_seen->p50, 0.004, kRound);
  EXPECT_NEAR(error.surface_seen->p95, 0.004, kRound);
  EXPECT_NEAR(error.tracking_seen->mean, 0.004, kRound);
}

TEST(TruthEvaluator, SeesSlidingAlongTheSurfaceInTheTrackingAlone) {
  LiveSnapshot snapshot = PerfectMap(3);
  Shift({0.03, 0.04, 0.0}, &snapshot);
  const FrameTruthError error = Evaluate(snapshot);
  EXPECT_NEAR(error.surface_seen->max, 0.0, kRound);
  EXPECT_NEAR(error.tracking_seen->mean, 0.05, kRound);
  EXPECT_NEAR(error.tracking_seen->p50, 0.05, kRound);
}

TEST(TruthEvaluator, TellsSeenFromHidden) {
  LiveSnapshot snapshot = PerfectMap(1);
  // One point is far behind the surface, another one outside the picture.
  snapshot.points[0].z() += 0.1;
  snapshot.points[1].x() += 1.5;
  const FrameTruthError error = Evaluate(snapshot);
  EXPECT_EQ(error.seen, 79);
  EXPECT_NEAR(error.surface_seen->max, 0.0, kRound);
  EXPECT_NEAR(error.surface_all->max, 0.1, kRound);
  EXPECT_NEAR(error.tracking_seen->max, 0.0, kRound);
  EXPECT_NEAR(error.tracking_hidden->mean, 0.5 * (0.1 + 1.5), kRound);
}

TEST(TruthEvaluator, LeavesPointsBornOffTheSurfaceOutOfTheTracking) {
  SequenceEvaluationOptions options;
  LiveSnapshot snapshot = PerfectMap(1);
  snapshot.birth_points[0].z() -= 1.02 * options.max_birth_offset;
  snapshot.birth_points[1].z() -= 0.9 * options.max_birth_offset;
  snapshot.points[0].x() += 0.2;
  const FrameTruthError error = Evaluate(snapshot);
  EXPECT_EQ(error.unknown, 1);
  EXPECT_NEAR(error.tracking_seen->max, 0.0, kRound);
  EXPECT_EQ(error.seen, 81);
}

TEST(TruthEvaluator, RemembersWherePointsWereBorn) {
  const SceneTruth truth = MovingPlane();
  TruthEvaluator evaluator(MakeCamera(), truth);
  LiveSnapshot snapshot = PerfectMap(0);
  ASSERT_TRUE(evaluator.Evaluate(snapshot).ok());
  // More points of a later frame join the known ones.
  snapshot = PerfectMap(2);
  const LiveSnapshot born_later = PerfectMap(2, 1);
  for (std::size_t i = 0; i < born_later.size(); ++i) {
    snapshot.points.push_back(born_later.points[i] + Eigen::Vector3d(0.01, 0.0, 0.0));
    snapshot.ids.push_back(born_later.ids[i]);
    snapshot.birth_frames.push_back(born_later.birth_frames[i]);
    snapshot.birth_points.push_back(born_later.birth_points[i]);
  }
  const StatusOr<FrameTruthError> error = evaluator.Evaluate(snapshot);
  ASSERT_TRUE(error.ok()) << error.status().message();
  EXPECT_EQ(error->points, 162);
  EXPECT_NEAR(error->tracking_seen->mean, 0.5 * 0.01, kRound);
  EXPECT_NEAR(error->tracking_seen->max, 0.01, kRound);
}

TEST(TruthEvaluator, RefusesWhatCannotBe) {
  const SceneTruth truth = MovingPlane();
  TruthEvaluator evaluator(MakeCamera(), truth);
  EXPECT_THAT(evaluator.Evaluate(PerfectMap(kFrames)).status().message(), HasSubstr("no frame 4"));
  LiveSnapshot snapshot = PerfectMap(1);
  snapshot.birth_frames[5] = 2;
  EXPECT_THAT(evaluator.Evaluate(snapshot).status().message(),
              HasSubstr("point 5 was born in frame 2, expected a frame of the sequence up to 1"));
  ASSERT_TRUE(evaluator.Evaluate(PerfectMap(1)).ok());
  snapshot = PerfectMap(2);
  snapshot.birth_frames[7] = 1;
  EXPECT_THAT(evaluator.Evaluate(snapshot).status().message(),
              HasSubstr("point 7 was born in frame 1, expected frame 0"));
}

TEST(CompareWithDepth, MeasuresAlongTheAxisWhereThereIsADepth) {
  LiveSnapshot snapshot = PerfectMap(0);
  Shift({0.0, 0.0, 0.003}, &snapshot);
  DepthImage depth(100, 100, 1.0f);
  const auto pixel = MakeCamera().Project(snapshot.points[3]);
  depth(std::lround(pixel.x()), std::lround(pixel.y())) = 0.0f;
  const DepthAgreement agreement = CompareWithDepth(MakeCamera(), snapshot, depth);
  EXPECT_EQ(agreement.seen, 81);
  EXPECT_EQ(agreement.measured, 80);
  EXPECT_NEAR(agreement.residual->p50, 0.003, kRound);
  EXPECT_NEAR(agreement.residual->max, 0.003, kRound);
}

TEST(CompareWithDepth, CountsTheShareOfPointsFarFromTheDepth) {
  LiveSnapshot snapshot = PerfectMap(0);
  for (int i = 0; i < 9; ++i) snapshot.points[i].z() -= 0.004;
  for (int i = 9; i < 20; ++i) snapshot.points[i].z() += 0.002;
  SequenceEvaluationOptions options;
  const DepthImage depth(100, 100, 1.0f);
  const DepthAgreement agreement = CompareWithDepth(MakeCamera(), snapshot, depth, options);
  EXPECT_DOUBLE_EQ(*agreement.far_share, 9.0 / 81.0);
  options.far_residual = 0.001;
  EXPECT_DOUBLE_EQ(*CompareWithDepth(MakeCamera(), snapshot, depth, options).far_share,
                   20.0 / 81.0);
  const AcrossFrames across = SummarizeFarShare({agreement, DepthAgreement()});
  EXPECT_EQ(across.frames, 1);
  EXPECT_DOUBLE_EQ(across.max, 9.0 / 81.0);
  EXPECT_FALSE(CompareWithDepth(MakeCamera(), snapshot, DepthImage(100, 100, 0.0f)).far_share);
}

TEST(CompareWithDepth, LeavesOutWhatTheMapItselfHides) {
  LiveSnapshot snapshot = PerfectMap(0);
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      snapshot.points.push_back({0.08 * (i - 4), 0.08 * (j - 4), 1.3});
    }
  }
  const DepthAgreement agreement =
      CompareWithDepth(MakeCamera(), snapshot, DepthImage(100, 100, 1.0f));
  EXPECT_EQ(agreement.points, 162);
  EXPECT_EQ(agreement.seen, 81);
  EXPECT_NEAR(agreement.residual->max, 0.0, kRound);
}

TEST(SummarizeFrames, CountsOnlyFramesThatHaveTheFigure) {
  const AcrossFrames across = SummarizeFrames({3.0, std::nullopt, 1.0, 8.0});
  EXPECT_EQ(across.frames, 3);
  EXPECT_DOUBLE_EQ(across.mean, 4.0);
  EXPECT_DOUBLE_EQ(across.median, 3.0);
  EXPECT_DOUBLE_EQ(across.max, 8.0);
  EXPECT_EQ(SummarizeFrames({std::nullopt}).frames, 0);
}

TEST(SequenceEvaluationOptions, MustBePositive) {
  std::string error;
  EXPECT_TRUE(SequenceEvaluationOptions().IsValid(&error));
  SequenceEvaluationOptions options;
  options.visibility_tolerance = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("visibility_tolerance is 0.0"));
}

}  // namespace
}  // namespace ceres_ed
