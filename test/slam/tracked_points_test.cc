#include "ceres_ed/slam/tracked_points.h"

#include <ceres_ed/slam/map/deformable_map.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/slam/bumpy_sequence.h>
#include <test/slam/slam_runs.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

FrameStatus Process(const DepthImage& depth, int number, DeformableSlam* slam) {
  SlamFrame frame;
  frame.number = number;
  frame.depth = &depth;
  return slam->Process(frame).status;
}

// Returns a point of the sheet in frame 0.
Eigen::Vector3d PointAt(const BumpyScene& scene, double u, double v) {
  return BumpyCamera().BackProject(u, v, scene.Depth(u, v, 0));
}

TEST(TrackedPoints, AreWhereTheyWereGivenInTheFirstFrame) {
  const BumpyScene scene;
  const std::unique_ptr<DeformableSlam> slam = MakeBumpySlam();
  ASSERT_EQ(Process(scene.RenderDepth(0), 0, slam.get()), FrameStatus::kInitialized);
  const std::vector<NamedPoint> named = {{4, PointAt(scene, 20, 30)}, {9, PointAt(scene, 70, 50)}};
  const auto tracked = TrackedPoints::Bind(named, *slam, BumpyCamera());
  ASSERT_TRUE(tracked.ok()) << tracked.status().message();
  ASSERT_EQ(tracked->size(), 2);
  EXPECT_EQ(tracked->id(1), 9);
  const std::vector<TrackedPlace> places = tracked->Locate(*slam, BumpyCamera());
  for (int i = 0; i < 2; ++i) {
    EXPECT_LT((places[i].in_camera - named[i].position).norm(), 1e-12);
    EXPECT_TRUE(places[i].visible);
  }
}

TEST(TrackedPoints, FollowTheTissuePastACameraThatMoves) {
  BumpyScene scene;
  scene.camera_step = 0.001;
  const std::unique_ptr<DeformableSlam> slam = MakeBumpySlam();
  Process(scene.RenderDepth(0), 0, slam.get());
  const std::vector<NamedPoint> named = {{0, PointAt(scene, 47, 35)}, {1, PointAt(scene, 3, 35)}};
  const auto tracked = TrackedPoints::Bind(named, *slam, BumpyCamera());
  ASSERT_TRUE(tracked.ok()) << tracked.status().message();
  for (int frame = 1; frame <= 6; ++frame) {
    ASSERT_EQ(Process(scene.RenderDepth(frame), frame, slam.get()), FrameStatus::kTracked);
  }
  const std::vector<TrackedPlace> places = tracked->Locate(*slam, BumpyCamera());
  // The camera moved by 6 mm along x; a pixel is 1.1 mm wide at this distance.
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d truth = named[i].position - scene.CameraPosition(6);
    EXPECT_LT((places[i].in_camera - truth).norm(), 0.6e-3) << i;
  }
  EXPECT_TRUE(places[0].visible);
  // The point was 0.09 m * 3 pixels / 90 = 3 mm from the edge, so it is now outside.
  EXPECT_FALSE(places[1].visible);
}

// A plate covers the left half of the picture, in front of the sheet.
TEST(TrackedPoints, AreNotVisibleBehindTheMap) {
  const BumpyScene sheet;
  DepthImage depth = sheet.RenderDepth(0);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < 48; ++u) depth(u, v) = 0.06f;
  }
  const std::unique_ptr<DeformableSlam> slam = MakeBumpySlam();
  ASSERT_EQ(Process(depth, 0, slam.get()), FrameStatus::kInitialized);
  TrackedPointsOptions options;
  // The hidden point is 40 mm behind the plate.
  options.max_distance = 0.05 / slam->unit();
  const std::vector<NamedPoint> named = {{0, PointAt(sheet, 20, 35)}, {1, PointAt(sheet, 75, 35)}};
  const auto tracked = TrackedPoints::Bind(named, *slam, BumpyCamera(), options);
  ASSERT_TRUE(tracked.ok()) << tracked.status().message();
  const std::vector<TrackedPlace> places = tracked->Locate(*slam, BumpyCamera());
  EXPECT_FALSE(places[0].visible);
  EXPECT_TRUE(places[1].visible);
}

// A sheet that is turned by 70 degrees: it is deeper across a cell of the z-buffer than what counts
// as hidden. Its points are visible all the same, as the map's own points are.
TEST(TrackedPoints, AreVisibleOnASteepSurface) {
  const PinholeCamera camera = BumpyCamera();
  const double slope = std::tan(70.0 * M_PI / 180.0);
  const auto depth_at = [&](int u) {
    // z = 0.1 + slope * x, with x in the camera frame.
    return 0.1 / (1.0 - slope * camera.BackProject(u, 0.0, 1.0).x());
  };
  DepthImage depth(camera.width, camera.height);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < 60; ++u) depth(u, v) = static_cast<float>(depth_at(u));
  }
  const std::unique_ptr<DeformableSlam> slam = MakeBumpySlam();
  ASSERT_EQ(Process(depth, 0, slam.get()), FrameStatus::kInitialized);
  std::vector<NamedPoint> named;
  for (int u = 10; u <= 50; ++u) named.push_back({u, camera.BackProject(u, 36, depth_at(u))});
  TrackedPointsOptions options;
  options.visibility.cell_size = 2.0;
  const auto tracked = TrackedPoints::Bind(named, *slam, camera, options);
  ASSERT_TRUE(tracked.ok()) << tracked.status().message();
  const std::vector<TrackedPlace> places = tracked->Locate(*slam, camera);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_TRUE(places[i].visible) << named[i].id;
}

TEST(TrackedPoints, RefuseAPointFarFromTheMapByName) {
  const BumpyScene scene;
  const std::unique_ptr<DeformableSlam> slam = MakeBumpySlam();
  Process(scene.RenderDepth(0), 0, slam.get());
  const std::vector<NamedPoint> named = {{3, PointAt(scene, 47, 35)}, {17, {0.0, 0.0, 0.5}}};
  const auto tracked = TrackedPoints::Bind(named, *slam, BumpyCamera());
  ASSERT_FALSE(tracked.ok());
  EXPECT_THAT(tracked.status().message(), HasSubstr("point 17 at (0, 0, 0.5) m is 0.3"));
  EXPECT_THAT(tracked.status().message(), HasSubstr("expected at most 0.0"));
}

}  // namespace
}  // namespace ceres_ed
