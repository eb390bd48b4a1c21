#include "ceres_ed/slam/frame/camera_tracker.h"

#include <ceres_ed/util/random.h>

#include <cmath>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>

namespace ceres_ed {
namespace {

// Returns the pose of the camera, relative to the start of the tests.
CameraPose TruePose() { return Motion(0.06, {0.3, 1.0, -0.5}, {0.12, -0.08, 0.1}); }

double AngleBetween(const CameraPose& a, const CameraPose& b) {
  return a.rotation.angularDistance(b.rotation);
}

// A surface, and map points that lie on its patches under the true pose, so that only the search
// can cause an error.
struct TrackedScene {
  template <typename Scene>
  TrackedScene(const Scene& scene, const CameraPose& truth)
      : surface(RenderDepth(SmallCamera(), scene), SmallCamera(), 1.0, ObservedSurfaceOptions()),
        truth(truth) {
    for (int j = 2; j < surface.height() - 2; j += 2) {
      for (int i = 2; i < surface.width() - 2; i += 2) {
        const SurfacePatch& patch = surface.patch(i, j);
        points.push_back(MakeVisible(SmallCamera(), truth, patch.point, patch.normal));
      }
    }
  }

  CameraTrackerResult Track(const CameraPose& start,
                            const std::vector<PointMatch>& matches = {}) const {
    CameraTrackerOptions options;
    options.max_iterations = 50;
    // Only the search can cause an error, not the share of the motion that is not believed.
    options.strength_floor = 1e-8;
    return TrackCamera(points, matches, surface, start, options);
  }

  ObservedSurface surface;
  CameraPose truth;
  std::vector<VisiblePoint> points;
};

TEST(TrackCamera, FindsAKnownMotion) {
  const TrackedScene scene(HillScene(), TruePose());
  const CameraTrackerResult result = scene.Track(CameraPose());
  EXPECT_LT(AngleBetween(result.camera_from_map, scene.truth), 1e-6);
  EXPECT_LT((result.camera_from_map.translation - scene.truth.translation).norm(), 1e-6 * 8.0);
  EXPECT_EQ(result.measured, static_cast<int>(scene.points.size()));
  EXPECT_LT(result.deviation, 1e-6);
  EXPECT_GT(result.inliers, 0.9 * result.measured);
}

TEST(TrackCamera, IsNotMovedByOutliers) {
  TrackedScene scene(HillScene(), TruePose());
  Random random(5);
  int outliers = 0;
  for (std::size_t k = 0; k < scene.points.size(); ++k) {
    if (k % 10 >= 3) continue;
    ++outliers;
    // All points move to the same side, so that their mean is not zero.
    scene.points[k].in_map -= (0.1 + 0.7 * random.Uniform()) * scene.points[k].normal_in_map;
  }
  const CameraTrackerResult result = scene.Track(CameraPose());
  EXPECT_LT(AngleBetween(result.camera_from_map, scene.truth), 1e-6);
  EXPECT_LT((result.camera_from_map.translation - scene.truth.translation).norm(), 1e-6 * 8.0);
  EXPECT_LT(result.inliers, (1.0 - 0.9 * outliers / scene.points.size()) * result.measured);
}

// The map uses the formula itself and not the patches of the surface, so that the remaining error
// is that of the patches.
TEST(TrackCamera, FindsTheMotionOfAnIndependentMap) {
  HillScene scene;
  scene.camera_from_map = TruePose();
  const ObservedSurface surface(
      RenderDepth(SmallCamera(), scene), SmallCamera(), 1.0, ObservedSurfaceOptions());
  std::vector<VisiblePoint> points;
  for (double y = -2.8; y < 2.8; y += 0.13) {
    for (double x = -3.8; x < 3.8; x += 0.13) {
      const double h = 1e-5;
      const auto hills = HillScene::Hills;
      const Eigen::Vector3d normal((hills(x + h, y) - hills(x - h, y)) / (2.0 * h),
                                   (hills(x, y + h) - hills(x, y - h)) / (2.0 * h),
                                   -1.0);
      VisiblePoint point;
      point.in_map = {x, y, scene.depth + hills(x, y)};
      point.normal_in_map = normal.normalized();
      points.push_back(point);
    }
  }
  const CameraTrackerResult result = TrackCamera(points, {}, surface, CameraPose(), {});
  // The mean square distance of a window's pixels from its middle is 4 x 4 pixels, here 0.018 in
  // each direction. At hills of curvature 1 the error of a fit is half the sum of both, 0.018. The
  // errors of crests and valleys cancel to a quarter or better; the view reaches 4 to each side.
  EXPECT_LT((result.camera_from_map.translation - scene.camera_from_map.translation).norm(),
            0.25 * 0.018);
  EXPECT_LT(AngleBetween(result.camera_from_map, scene.camera_from_map), 0.25 * 0.018 / 4.0);
}

// A flat sheet does not determine a slide along itself and a rotation about its normal.
TEST(TrackCamera, KeepsWhatAFlatSheetLeavesOpen) {
  const PlaneScene plane = TiltedPlane(6.0, 25.0, 50.0);
  const TrackedScene scene(plane, CameraPose());
  const Eigen::Vector3d slide = 0.2 * plane.normal.unitOrthogonal();
  CameraPose start;
  start.translation = slide + 0.15 * plane.normal;
  const CameraTrackerResult result = scene.Track(start);
  const Eigen::Vector3d moved = result.camera_from_map.translation - start.translation;
  EXPECT_NEAR(moved.dot(plane.normal), -0.15, 1e-5);
  EXPECT_LT((moved - moved.dot(plane.normal) * plane.normal).norm(), 1e-5);
  EXPECT_LT(AngleBetween(result.camera_from_map, start), 1e-5);
}

TEST(TrackCamera, FindsTheSlideByPointMatches) {
  const PlaneScene plane = TiltedPlane(6.0, 25.0, 50.0);
  const CameraPose truth = Motion(0.03, plane.normal, {0.1, -0.05, 0.02});
  const TrackedScene scene(plane, truth);
  std::vector<PointMatch> matches;
  for (std::size_t k = 0; k < scene.points.size(); k += 40) {
    matches.push_back({scene.points[k].in_map, scene.points[k].in_camera});
  }
  // Every fifth match is wrong.
  for (std::size_t k = 0; k < matches.size(); k += 5) matches[k].in_camera.x() += 0.5;
  const CameraTrackerResult result = scene.Track(CameraPose(), matches);
  EXPECT_LT(AngleBetween(result.camera_from_map, truth), 1e-6);
  EXPECT_LT((result.camera_from_map.translation - truth.translation).norm(), 1e-6 * 6.0);
}

TEST(TrackCamera, ReturnsTheStartWhereThereIsTooLittleToSee) {
  const TrackedScene scene(HillScene(), TruePose());
  const CameraPose start = Motion(0.01, {1.0, 0.0, 0.0}, {0.01, 0.02, 0.03});
  const auto stays = [&](const std::vector<VisiblePoint>& points, const ObservedSurface& surface) {
    const CameraTrackerResult result = TrackCamera(points, {}, surface, start, {});
    EXPECT_EQ(result.camera_from_map.rotation.coeffs(), start.rotation.coeffs());
    EXPECT_EQ(result.camera_from_map.translation, start.translation);
    return result;
  };
  EXPECT_EQ(stays({}, scene.surface).inliers, 0);
  stays({scene.points.begin(), scene.points.begin() + 5}, scene.surface);
  const ObservedSurface nothing(
      DepthImage(160, 120, 0.0F), SmallCamera(), 1.0, ObservedSurfaceOptions());
  EXPECT_EQ(stays(scene.points, nothing).measured, 0);
}

TEST(TrackCamera, OnlyMeasuresWithoutIterations) {
  const TrackedScene scene(HillScene(), TruePose());
  CameraTrackerOptions options;
  options.max_iterations = 0;
  const CameraTrackerResult result =
      TrackCamera(scene.points, {}, scene.surface, TruePose(), options);
  EXPECT_EQ(result.camera_from_map.translation, TruePose().translation);
  EXPECT_LT(result.deviation, 1e-12);
  EXPECT_EQ(result.inliers, static_cast<int>(scene.points.size()));
}

// A ball looks the same from all sides: nothing determines a rotation about its centre.
TEST(TrackCamera, DoesNotTurnAboutTheCentreOfABall) {
  const Eigen::Vector3d center(0.2, -0.1, 9.0);
  constexpr double kRadius = 4.0;
  const auto ball = [&](const Eigen::Vector3d& ray) {
    const double a = ray.squaredNorm();
    const double b = ray.dot(center);
    const double root = b * b - a * (center.squaredNorm() - kRadius * kRadius);
    return root > 0.0 ? (b - std::sqrt(root)) / a : 0.0;
  };
  const TrackedScene scene(ball, CameraPose());
  // The start is turned about the centre, and is too near, which the ball does determine.
  CameraPose start = Motion(0.1, {0.3, 1.0, 0.2}, {0.0, 0.0, 0.0});
  start.translation = center - start.rotation * center + Eigen::Vector3d(0.0, 0.0, 0.15);
  const CameraTrackerResult result = TrackCamera(scene.points, {}, scene.surface, start, {});
  EXPECT_LT(AngleBetween(result.camera_from_map, start), 0.01);
  EXPECT_LT(std::abs((result.camera_from_map * center - center).z()), 0.01);
  EXPECT_EQ(result.information.NumWeak(), 3);
  // What a step did in these directions is not a velocity.
  CameraPose turn = Motion(0.1, {0.3, 1.0, 0.2}, {0.0, 0.0, 0.0});
  turn.translation = center - turn.rotation * center;
  EXPECT_LT(result.information.DeterminedPart(turn).rotation.angularDistance(CameraPose().rotation),
            0.02);
}

// Most of the picture is a wall, along which the camera slides; only a ball before it tells. Exact
// depth makes the wall fit exactly, but it does not make the ball an error.
TEST(TrackCamera, BelievesTheSmallPartThatDeterminesAMotion) {
  const auto scene_at = [](const Eigen::Vector3d& ball) {
    return [ball](const Eigen::Vector3d& ray) {
      const double a = ray.squaredNorm();
      const double b = ray.dot(ball);
      const double root = b * b - a * (ball.squaredNorm() - 1.0);
      return root > 0.0 ? (b - std::sqrt(root)) / a : 10.0;
    };
  };
  const CameraPose truth = Motion(0.0, {0.0, 0.0, 1.0}, {0.15, 0.1, 0.0});
  const TrackedScene scene(scene_at({0.15, 0.1, 7.0}), truth);
  const CameraTrackerResult result =
      TrackCamera(scene.points, {}, scene.surface, CameraPose(), CameraTrackerOptions());
  EXPECT_LT((result.camera_from_map.translation - truth.translation).norm(), 0.01);
  EXPECT_LT(AngleBetween(result.camera_from_map, truth), 0.01);
}

TEST(Misfit, IsLeastAtTheTruePose) {
  const TrackedScene scene(HillScene(), TruePose());
  const double right = Misfit(scene.points, TruePose(), scene.surface);
  EXPECT_LT(right, 1e-6);
  EXPECT_GT(Misfit(scene.points, CameraPose(), scene.surface), 10.0 * right + 1e-4);
  EXPECT_EQ(Misfit({}, CameraPose(), scene.surface), 1.0);
}

}  // namespace
}  // namespace ceres_ed
