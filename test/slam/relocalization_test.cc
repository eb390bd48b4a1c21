#include "ceres_ed/slam/frame/relocalization.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/slam_runs.h>

namespace ceres_ed {
namespace {

// Returns the map of the kidney from frames 0 to 3.
std::unique_ptr<DeformableSlam> MappedKidney() {
  std::unique_ptr<DeformableSlam> slam = MakeSlam(KidneySequence().camera, FastOptions());
  for (int k = 0; k < 4; ++k) slam->Process(KidneySequence().Frame(k));
  return slam;
}

ObservedSurface SurfaceOf(const DeformableSlam& slam, int frame) {
  return ObservedSurface(KidneySequence().Frame(frame).depth,
                         KidneySequence().camera,
                         1.0 / slam.unit(),
                         ObservedSurfaceOptions());
}

// Returns `pose` with the camera rotated by `degrees` about the centre of the scene, at `distance`
// in front of it.
CameraPose TurnedAway(const CameraPose& pose, double degrees, double distance) {
  const Eigen::Vector3d center(0.0, 0.0, distance);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(degrees * M_PI / 180.0, Eigen::Vector3d::UnitY()));
  CameraPose turned;
  turned.rotation = turn * pose.rotation;
  turned.translation = turn * (pose.translation - center) + center;
  return turned;
}

std::vector<Eigen::Vector3d> NodePositions(const DeformableSlam& slam) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(slam.map().graph().num_nodes());
  for (int j = 0; j < slam.map().graph().num_nodes(); ++j) {
    positions.push_back(slam.map().NodePosition(j));
  }
  return positions;
}

// Returns the picture rotated by half a turn, which no prediction can reach.
DepthImage TurnedByHalf(DepthView depth) {
  DepthImage turned(depth.width(), depth.height());
  for (int v = 0; v < turned.height(); ++v) {
    for (int u = 0; u < turned.width(); ++u) {
      turned(u, v) = depth(turned.width() - 1 - u, turned.height() - 1 - v);
    }
  }
  return turned;
}

double MiddleDepth(const ObservedSurface& surface) {
  const SurfacePatch& patch = surface.patch(surface.width() / 2, surface.height() / 2);
  return patch.point.z();
}

TEST(Relocalization, JudgesTheTrueAndAFalsePoseApart) {
  const auto slam = MappedKidney();
  const ObservedSurface surface = SurfaceOf(*slam, 3);
  const PoseQualityOptions judge;
  const auto quality = [&](const CameraPose& pose) {
    return JudgePose(FindVisible(slam->map(), pose, surface.camera(), VisibilityOptions()),
                     pose,
                     surface,
                     judge);
  };
  const PoseQuality right = quality(slam->camera_from_map());
  EXPECT_FALSE(judge.Doubts(right)) << right.overlap << " " << right.deviation;
  EXPECT_TRUE(judge.Believes(right));
  const PoseQuality wrong =
      quality(TurnedAway(slam->camera_from_map(), 40.0, MiddleDepth(surface)));
  EXPECT_TRUE(judge.Doubts(wrong)) << wrong.overlap << " " << wrong.deviation;
  EXPECT_LT(wrong.Score(), 0.5 * right.Score());
}

TEST(Relocalization, FindsTheCameraAgain) {
  const auto slam = MappedKidney();
  const ObservedSurface surface = SurfaceOf(*slam, 3);
  const CameraPose truth = slam->camera_from_map();
  const CameraPose lost = TurnedAway(truth, 35.0, MiddleDepth(surface));
  const Relocalization found =
      Relocalize(slam->map(), surface, lost, VisibilityOptions(), PoseQualityOptions());
  EXPECT_FALSE(PoseQualityOptions().Doubts(found.quality));
  // A smooth body may slide along itself a little: by a tenth of a node spacing, of about eight
  // across the body.
  const Eigen::Vector3d center = truth.ApplyInverse({0.0, 0.0, MiddleDepth(surface)});
  EXPECT_LT((found.camera_from_map * center - truth * center).norm(), 0.1);
  EXPECT_LT(found.camera_from_map.rotation.angularDistance(truth.rotation), 2.0 * M_PI / 180.0);
}

TEST(Relocalization, TracksOnAfterAJump) {
  const auto slam = MappedKidney();
  const SlamFrame frame = KidneySequence().Frame(3);
  const DepthImage turned = TurnedByHalf(frame.depth);
  SlamFrame jumped = frame;
  jumped.depth = &turned;
  jumped.color = nullptr;
  jumped.number = 4;
  const CameraPose before = slam->camera_from_map();
  EXPECT_EQ(slam->Process(jumped).status, FrameStatus::kRelocalized);
  const double angle = slam->camera_from_map().rotation.angularDistance(before.rotation);
  EXPECT_NEAR(angle, M_PI, 5.0 * M_PI / 180.0);
}

// A pose that depth alone has found may be wrong. Until several frames agree with it nothing of the
// map may change.
TEST(Relocalization, LeavesTheMapAloneUntilThePoseHasProvedItself) {
  const auto slam = MappedKidney();
  const SlamFrame frame = KidneySequence().Frame(3);
  const DepthImage turned = TurnedByHalf(frame.depth);
  SlamFrame jumped = frame;
  jumped.depth = &turned;
  jumped.color = nullptr;
  const std::vector<Eigen::Vector3d> before = NodePositions(*slam);
  const int points = slam->map().num_points();
  int proving = 0;
  for (int k = 4; k < 12; ++k) {
    jumped.number = k;
    const FrameReport report = slam->Process(jumped);
    EXPECT_EQ(report.status, k == 4 ? FrameStatus::kRelocalized : FrameStatus::kTracked) << k;
    // How well the map lies on the surface is known all the same.
    EXPECT_GT(report.overlap, 0.5) << k;
    // A frame that changes the map is solved.
    if (report.iterations > 0) break;
    ++proving;
    EXPECT_EQ(slam->map().num_points(), points);
    EXPECT_EQ(NodePositions(*slam), before);
  }
  EXPECT_EQ(proving, 5);
}

TEST(Relocalization, SaysLostAndLeavesTheMapAlone) {
  const auto slam = MappedKidney();
  // A wall much nearer than the organ, which was never mapped.
  DepthImage wall(KidneySequence().camera.width, KidneySequence().camera.height);
  for (int v = 0; v < wall.height(); ++v) {
    for (int u = 0; u < wall.width(); ++u) {
      wall(u, v) = 0.02F + 0.00002F * static_cast<float>((u * 7 + v * 3) % 50);
    }
  }
  SlamFrame frame = KidneySequence().Frame(3);
  frame.depth = &wall;
  frame.color = nullptr;
  frame.number = 4;
  const CameraPose before = slam->camera_from_map();
  const int points = slam->map().num_points();
  const int nodes = slam->map().graph().num_nodes();
  EXPECT_EQ(slam->Process(frame).status, FrameStatus::kLost);
  EXPECT_EQ(slam->camera_from_map().translation, before.translation);
  EXPECT_EQ(slam->camera_from_map().rotation.coeffs(), before.rotation.coeffs());
  EXPECT_EQ(slam->map().num_points(), points);
  EXPECT_EQ(slam->map().graph().num_nodes(), nodes);
  // Tracking continues when the organ is in view again.
  EXPECT_EQ(slam->Process(KidneySequence().Frame(4)).status, FrameStatus::kTracked);
}

}  // namespace
}  // namespace ceres_ed
