#include "ceres_ed/evaluation/track_following.h"

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// One pixel corresponds to 0.02 at z = 1.
PinholeCamera MakeCamera() { return {50.0, 50.0, 49.5, 49.5, 100, 100}; }

// Returns a plane z = 1 with a point every 3 pixels, which moves `pixels` to the right per frame.
LiveSnapshot PlaneAt(int frame, double pixels) {
  LiveSnapshot snapshot;
  snapshot.frame = frame;
  for (int v = 20; v <= 80; v += 3) {
    for (int u = 20; u <= 80; u += 3) {
      snapshot.ids.push_back(100 * v + u);
      snapshot.points.push_back(MakeCamera().BackProject(u + pixels * frame, v, 1.0));
      snapshot.birth_frames.push_back(0);
      snapshot.birth_points.push_back(MakeCamera().BackProject(u, v, 1.0));
    }
  }
  return snapshot;
}

TEST(TrackFollower, FollowsWhatMovesWithTheMap) {
  TrackFollower follower(MakeCamera(), {{0, 1, {50.3, 41.2}}, {2, 1, {54.3, 41.2}}});
  for (int frame = 0; frame < 3; ++frame) follower.Add(PlaneAt(frame, 2.0));
  const TrackEvaluation evaluation = follower.Evaluate();
  EXPECT_EQ(evaluation.tracks, 1);
  EXPECT_EQ(evaluation.followed, 1);
  EXPECT_EQ(evaluation.late, 0);
  EXPECT_EQ(evaluation.lost, 0);
  ASSERT_TRUE(evaluation.error);
  EXPECT_NEAR(evaluation.error->max, 0.0, 1e-9);
  ASSERT_EQ(evaluation.frames.size(), 3u);
  EXPECT_EQ(evaluation.frames[1].tracks, 0);
  EXPECT_EQ(evaluation.frames[2].tracks, 1);
}

TEST(TrackFollower, MeasuresAKnownOffsetInEveryFrameButTheFirst) {
  std::vector<TrackObservation> observations;
  for (int track = 0; track < 5; ++track) {
    for (int frame = 0; frame < 4; ++frame) {
      const Eigen::Vector2d offset = frame == 0 ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(3, -4);
      observations.push_back({frame, track, Eigen::Vector2d(30 + 7 * track, 47) + offset});
    }
  }
  TrackFollower follower(MakeCamera(), observations);
  for (int frame = 0; frame < 4; ++frame) follower.Add(PlaneAt(frame, 0.0));
  const TrackEvaluation evaluation = follower.Evaluate();
  EXPECT_EQ(evaluation.followed, 5);
  EXPECT_NEAR(evaluation.error->p50, 5.0, 1e-9);
  EXPECT_NEAR(evaluation.error->mean, 5.0, 1e-9);
  EXPECT_EQ(evaluation.frames[3].tracks, 5);
}

TEST(TrackFollower, CountsTheEndsOfTracksThatMoveFarApart) {
  // The map moves by 2 pixels in a frame; one track by 3, the other stands still.
  std::vector<TrackObservation> observations;
  for (int frame = 0; frame < 11; ++frame) {
    observations.push_back({frame, 0, {30.0 + 3.0 * frame, 47.0}});
    observations.push_back({frame, 1, {60.0, 47.0}});
  }
  TrackFollowingOptions options;
  options.moved_distance = 25.0;
  TrackFollower follower(MakeCamera(), observations, options);
  for (int frame = 0; frame < 11; ++frame) follower.Add(PlaneAt(frame, 2.0));
  const TrackEvaluation evaluation = follower.Evaluate();
  EXPECT_EQ(evaluation.moved, 1);
  ASSERT_TRUE(evaluation.moved_error);
  EXPECT_NEAR(evaluation.moved_error->max, 10.0, 1e-9);
  EXPECT_NEAR(evaluation.error->max, 20.0, 1e-9);
}

TEST(TrackFollower, WeighsPointsByTheInverseOfTheirDistance) {
  // The track lies between two points, 1 pixel from one and 2 pixels from the other, and only the
  // second point moves.
  LiveSnapshot first;
  first.ids = {4, 9};
  first.points = {MakeCamera().BackProject(50, 50, 1.0), MakeCamera().BackProject(53, 50, 1.0)};
  LiveSnapshot second = first;
  second.frame = 1;
  second.points[1] = MakeCamera().BackProject(53, 56, 1.0);
  TrackFollower follower(MakeCamera(), {{0, 0, {51, 50}}, {1, 0, {51, 50}}});
  follower.Add(first);
  follower.Add(second);
  // (1/2) / (1 + 1/2) of 6 pixels.
  EXPECT_NEAR(follower.Evaluate().error->max, 2.0, 1e-9);
}

TEST(TrackFollower, TiesToTheSurfaceInFront) {
  LiveSnapshot first = PlaneAt(0, 0.0);
  LiveSnapshot second = PlaneAt(1, 1.0);
  for (LiveSnapshot* snapshot : {&first, &second}) {
    // A static wall is behind; one of its points is exactly at the track.
    for (int k = 0; k < 10; ++k) {
      snapshot->ids.push_back(k);
      snapshot->points.push_back(MakeCamera().BackProject(41 + 2.5 * k, 46, 1.5));
    }
  }
  TrackFollower follower(MakeCamera(), {{0, 0, {51, 46}}, {1, 0, {52, 46}}});
  follower.Add(first);
  follower.Add(second);
  EXPECT_NEAR(follower.Evaluate().error->max, 0.0, 1e-9);
}

TEST(TrackFollower, CountsTracksThatItCannotFollow) {
  // Four tracks: beside the map; beside it at first; given in no frame of the result; lost by the
  // map.
  TrackFollower follower(MakeCamera(),
                         {{0, 0, {5, 5}},
                          {1, 0, {6, 5}},
                          {0, 1, {5, 50}},
                          {1, 1, {50, 50}},
                          {2, 1, {50, 51}},
                          {7, 2, {50, 50}},
                          {0, 3, {35, 35}},
                          {2, 3, {35, 35}}});
  follower.Add(PlaneAt(0, 0.0));
  follower.Add(PlaneAt(1, 0.0));
  LiveSnapshot thinned = PlaneAt(2, 0.0);
  for (std::size_t i = 0; i < thinned.size(); ++i) {
    if (thinned.ids[i] < 4300) thinned.ids[i] += 100000;
  }
  follower.Add(thinned);
  const TrackEvaluation evaluation = follower.Evaluate();
  EXPECT_EQ(evaluation.tracks, 3);
  EXPECT_EQ(evaluation.followed, 2);
  EXPECT_EQ(evaluation.late, 1);
  EXPECT_EQ(evaluation.lost, 1);
  EXPECT_EQ(evaluation.frames[2].tracks, 2);
  EXPECT_EQ(evaluation.frames[2].lost, 1);
  EXPECT_NEAR(evaluation.error->max, 1.0, 1e-9);
}

}  // namespace
}  // namespace ceres_ed
