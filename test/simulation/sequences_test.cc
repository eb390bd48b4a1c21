#include <ceres_ed/evaluation/pair_evaluation.h>
#include <ceres_ed/simulation/sequences.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

SyntheticSequenceOptions Small(SyntheticSceneKind kind) {
  SyntheticSequenceOptions options;
  options.kind = kind;
  options.width = 80;
  options.height = 60;
  options.noise = 0.0;
  if (kind != SyntheticSceneKind::kStrip) options.vertices = 1000;
  return options;
}

// Returns the points that the pixels of a frame see, in the world frame.
std::vector<Eigen::Vector3d> SeenPoints(const SyntheticSequence& sequence,
                                        const SyntheticFrame& frame) {
  std::vector<Eigen::Vector3d> points;
  for (int v = 0; v < frame.depth.height(); ++v) {
    for (int u = 0; u < frame.depth.width(); ++u) {
      const double z = double(frame.depth(u, v));
      if (z > 0.0)
        points.push_back(frame.world_from_camera * sequence.camera().BackProject(u, v, z));
    }
  }
  return points;
}

double LargestMotion(const std::vector<Eigen::Vector3d>& one,
                     const std::vector<Eigen::Vector3d>& other) {
  double largest = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    largest = std::max(largest, (one[i] - other[i]).norm());
  }
  return largest;
}

std::vector<SyntheticSceneKind> AllScenes() {
  std::vector<SyntheticSceneKind> kinds;
  for (const auto& named : NamesOf(SyntheticSceneKind())) kinds.push_back(named.value);
  return kinds;
}

class EveryScene : public ::testing::TestWithParam<SyntheticSceneKind> {};

TEST_P(EveryScene, HasDepthThatLiesOnTheTruthOfItsFrame) {
  const SyntheticSequence sequence(Small(GetParam()));
  // Pictures and truth of the strip have different meshes: chords of 1.5 mm (2.1 mm along the
  // diagonal) differ from its relief by less than 0.2 mm. For the other scenes the only difference
  // is the rounding of the depth to float.
  const double tolerance = GetParam() == SyntheticSceneKind::kStrip ? 2e-4 : 1e-7;
  for (const int k : {0, 6, 9}) {
    const std::vector<Eigen::Vector3d> seen = SeenPoints(sequence, sequence.Render(k, false));
    EXPECT_GT(seen.size(), 80u * 60u / 4u);
    PointCloud truth = sequence.truth_mesh();
    truth.points = sequence.TruthPoints(k);
    const std::vector<double> distances = SurfaceDistances(seen, truth);
    EXPECT_LT(*std::max_element(distances.begin(), distances.end()), tolerance) << "frame " << k;
  }
}

TEST_P(EveryScene, IsAtRestInItsFirstFrame) {
  const SyntheticSequence sequence(Small(GetParam()));
  EXPECT_LT(LargestMotion(sequence.TruthPoints(0), sequence.truth_mesh().points), 1e-15);
}

TEST_P(EveryScene, MovesByMillimetresAndLittleInAFrame) {
  const SyntheticSequence sequence(Small(GetParam()));
  const int last = std::min(sequence.num_frames(), 13) - 1;
  EXPECT_GT(LargestMotion(sequence.TruthPoints(0), sequence.TruthPoints(last)), 3e-3);
  double largest = 0.0;
  for (int k = 1; k <= last; ++k) {
    largest =
        std::max(largest, LargestMotion(sequence.TruthPoints(k - 1), sequence.TruthPoints(k)));
  }
  EXPECT_LT(largest, 2.5e-3);
}

TEST_P(EveryScene, IsTheSameForTheSameSeedInAnyOrder) {
  SyntheticSequenceOptions options = Small(GetParam());
  options.noise = 1e-3;
  const SyntheticSequence one(options);
  const SyntheticSequence two(options);
  one.Render(0);
  const SyntheticFrame a = one.Render(2);
  const SyntheticFrame b = two.Render(2);
  EXPECT_EQ(a.depth.pixels(), b.depth.pixels());
  EXPECT_EQ(a.color.pixels(), b.color.pixels());
  EXPECT_EQ(a.world_from_camera.translation, b.world_from_camera.translation);
  options.seed = 2;
  const SyntheticFrame c = SyntheticSequence(options).Render(2);
  EXPECT_NE(a.depth.pixels(), c.depth.pixels());
  EXPECT_NE(a.color.pixels(), c.color.pixels());
}

TEST_P(EveryScene, ShowsAnUprightPictureOfTheSurfaceInFront) {
  const SyntheticSequence sequence(Small(GetParam()));
  for (const int k : {0, 5}) {
    const CameraPose pose = sequence.Render(k, false).world_from_camera;
    const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-12);
    // The y axis of the picture points down: against z around an organ, against y above a sheet.
    EXPECT_GT(std::max(-rotation(2, 1), -rotation(1, 1)), 0.9);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes,
                         EveryScene,
                         ::testing::ValuesIn(AllScenes()),
                         [](const auto& info) { return NameOf(info.param); });

TEST(Organs, AreSeenInPartByACameraThatMovesSmoothly) {
  for (const auto kind :
       {SyntheticSceneKind::kHeart, SyntheticSceneKind::kKidney, SyntheticSceneKind::kStomach}) {
    SyntheticSequenceOptions options = Small(kind);
    options.frames = 60;
    const SyntheticSequence sequence(options);
    double total = 0.0;
    CameraPose before = sequence.Render(0, false).world_from_camera;
    for (int k = 1; k < 60; ++k) {
      const CameraPose now = sequence.Render(k, false).world_from_camera;
      const double degrees = before.rotation.angularDistance(now.rotation) * 180.0 / M_PI;
      EXPECT_GT(degrees, 1.0);
      EXPECT_LT(degrees, 2.0);
      total += degrees;
      before = now;
    }
    EXPECT_NEAR(total, 100.0, 5.0);
    const double seen = SeenPoints(sequence, sequence.Render(20, false)).size() / (80.0 * 60.0);
    EXPECT_GT(seen, 0.4) << NameOf(kind);
  }
}

TEST(PlaneScene, IsSeenWholeAtRestAndByHalfLaterUnderAStillCamera) {
  const SyntheticSequence sequence(Small(SyntheticSceneKind::kPlane));
  ASSERT_EQ(sequence.num_frames(), 10);
  const SyntheticFrame first = sequence.Render(0);
  EXPECT_TRUE(first.mask.empty());
  const auto seen = [&](const SyntheticFrame& frame) {
    return double(SeenPoints(sequence, frame).size());
  };
  // The whole sheet with its border lies inside the picture.
  for (const Eigen::Vector3d& point : sequence.truth_mesh().points) {
    const Eigen::Vector3d in_camera = first.world_from_camera.rotation.conjugate() *
                                      (point - first.world_from_camera.translation);
    const Eigen::Vector2d pixel = sequence.camera().Project(in_camera);
    ASSERT_TRUE(pixel.x() > 0 && pixel.x() < 79 && pixel.y() > 0 && pixel.y() < 59) << pixel;
  }
  for (const int k : {1, 9}) {
    const SyntheticFrame later = sequence.Render(k);
    EXPECT_EQ(later.world_from_camera.translation, first.world_from_camera.translation);
    EXPECT_EQ(later.world_from_camera.rotation.coeffs(), first.world_from_camera.rotation.coeffs());
    EXPECT_NEAR(seen(later) / seen(first), 0.5, 0.06);
    for (std::size_t i = 0; i < later.mask.pixels().size(); ++i) {
      ASSERT_EQ(later.mask.pixels()[i] != 0, later.depth.pixels()[i] > 0.0F);
    }
  }
}

TEST(StripScene, ShowsTheSameSizeInEveryFrame) {
  SyntheticSequenceOptions options = Small(SyntheticSceneKind::kStrip);
  options.nodes_hint = 1500;
  const SyntheticSequence sequence(options);
  std::vector<double> seen;
  for (int k = 0; k < sequence.num_frames(); k += 3) {
    seen.push_back(SeenPoints(sequence, sequence.Render(k, false)).size());
  }
  seen.push_back(SeenPoints(sequence, sequence.Render(sequence.num_frames() - 1, false)).size());
  const auto [least, most] = std::minmax_element(seen.begin(), seen.end());
  // Because of the relief, the two borders of the band are nearer in some places and farther in
  // others.
  EXPECT_LT(*most / *least, 1.08);
  EXPECT_GT(*least, 0.7 * 80 * 60);
}

TEST(StripScene, HasTheLengthThatTheNodesNeedAndASteadyCamera) {
  SyntheticSequenceOptions options = Small(SyntheticSceneKind::kStrip);
  options.nodes_hint = 3000;
  const SyntheticSequence sequence(options);
  const double view = 0.1 * 80 / sequence.camera().fx;
  const int last = sequence.num_frames() - 1;
  const auto eye = [&](int k) { return sequence.Render(k, false).world_from_camera.translation; };
  EXPECT_NEAR((eye(last) - eye(0)).norm(), 9.0 * view, 1e-12);
  const double step = (eye(1) - eye(0)).norm();
  EXPECT_NEAR((eye(last) - eye(last - 1)).norm(), step, 1e-12);
  EXPECT_GT(step, 0.04 * view);
  EXPECT_LT(step, 0.06 * view);
}

TEST(StripScene, DrawsNoMoreOfALongerBand) {
  const SyntheticSequence sequence(Small(SyntheticSceneKind::kStrip));
  const auto vertices = [&](double views, int frame) {
    const auto scene =
        MakeStripScene(views * StripViewLength(sequence.camera()), 1000, 25.0, sequence.camera());
    return double(scene->RestPatch(frame).size());
  };
  EXPECT_NEAR(vertices(500.0, 500) / vertices(5.0, 500), 1.0, 0.01);
}

TEST(StripScene, MovesEverywhereAlsoWhereNobodyLooks) {
  SyntheticSequenceOptions options = Small(SyntheticSceneKind::kStrip);
  options.nodes_hint = 1500;
  const SyntheticSequence sequence(options);
  const std::vector<Eigen::Vector3d> rest = sequence.TruthPoints(0);
  std::vector<double> largest(rest.size(), 0.0);
  for (int k = 1; k < 25; ++k) {
    const std::vector<Eigen::Vector3d> now = sequence.TruthPoints(k);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      largest[i] = std::max(largest[i], (now[i] - rest[i]).norm());
    }
  }
  EXPECT_GT(*std::min_element(largest.begin(), largest.end()), 0.5e-3);
}

TEST(StripScene, TakesItsLengthFromTheFramesWhereTheseAreGiven) {
  SyntheticSequenceOptions options = Small(SyntheticSceneKind::kStrip);
  options.frames = 3;
  EXPECT_EQ(SyntheticSequence(options).num_frames(), 3);
  options.nodes_hint = 1000;
  std::string error;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("expected 9 or more"));
}

TEST(SyntheticSequence, ThinsTruthThatWouldBeTooLarge) {
  SyntheticSequenceOptions options = Small(SyntheticSceneKind::kStrip);
  options.nodes_hint = 600;
  options.frames = 21;
  const std::size_t all = SyntheticSequence(options).truth_mesh().size();
  EXPECT_EQ(SyntheticSequence(options).truth_note(), "");
  options.max_truth_bytes = 0.5 * 12.0 * 21.0 * double(all);
  const SyntheticSequence thinned(options);
  EXPECT_LE(thinned.truth_mesh().size(), all / 2);
  EXPECT_GT(double(thinned.truth_mesh().size()), 0.45 * double(all));
  EXPECT_THAT(thinned.truth_note(), HasSubstr("thinned to"));
  options.max_truth_bytes *= 0.1;
  const SyntheticSequence without(options);
  EXPECT_TRUE(without.truth_mesh().empty());
  EXPECT_TRUE(without.TruthPoints(1).empty());
  EXPECT_THAT(without.truth_note(), HasSubstr("left out"));
}

TEST(SyntheticSequence, RefusesOptionsOutOfRange) {
  const auto error_of = [](auto change) {
    SyntheticSequenceOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    return error;
  };
  using Options = SyntheticSequenceOptions;
  EXPECT_THAT(error_of([](Options* o) { o->frames = -1; }), HasSubstr("frames is -1"));
  EXPECT_THAT(error_of([](Options* o) { o->nodes_hint = 900; }), HasSubstr("strip only"));
  EXPECT_THAT(error_of([](Options* o) { o->vertices = 499; }), HasSubstr("vertices is 499"));
  EXPECT_THAT(error_of([](Options* o) { o->width = 15; }), HasSubstr("width is 15"));
  EXPECT_THAT(error_of([](Options* o) { o->noise = -1e-3; }), HasSubstr("noise is -0.001"));
  EXPECT_THAT(error_of([](Options* o) { o->noise = NAN; }), HasSubstr("noise is nan"));
  EXPECT_THAT(error_of([](Options* o) { o->period = 1.0; }), HasSubstr("period is 1"));
  EXPECT_THAT(error_of([](Options* o) {
                o->kind = SyntheticSceneKind::kStrip;
                o->nodes_hint = 299;
              }),
              HasSubstr("nodes_hint is 299"));
}

}  // namespace
}  // namespace ceres_ed
