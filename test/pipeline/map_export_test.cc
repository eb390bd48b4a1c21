#include "ceres_ed/pipeline/slam/map_export.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/slam/map/deformable_map.h>

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/bumpy_sequence.h>

namespace ceres_ed {
namespace {

// The map after two frames, between which the camera went half a millimetre.
class MapExportTest : public ::testing::Test {
 protected:
  MapExportTest() {
    RegisterBuiltinEnergies(&registry_);
    SlamOptions options;
    options.nodes_in_view = 40;
    options.features = false;
    auto slam = DeformableSlam::Create(BumpyCamera(), options, registry_);
    EXPECT_TRUE(slam.ok()) << slam.status().message();
    slam_ = *std::move(slam);
    for (int number = 0; number < 2; ++number) {
      const DepthImage depth = BumpyScene().RenderDepth(number);
      SlamFrame frame;
      frame.number = number;
      frame.depth = &depth;
      frame.catch_up = true;
      slam_->Process(frame);
    }
  }

  EnergyRegistry registry_;
  std::unique_ptr<DeformableSlam> slam_;
};

TEST_F(MapExportTest, GivesAllPointsInMetres) {
  const MapSnapshot map = ExportMap(*slam_);
  ASSERT_EQ(map.size(), static_cast<std::size_t>(slam_->map().num_points()));
  EXPECT_EQ(map.normals.size(), map.size());
  EXPECT_EQ(map.colors.size(), map.size());
  EXPECT_EQ(map.ids.size(), map.size());
  EXPECT_EQ(map.weights.size(), map.size());
  const BumpyScene scene;
  double sum = 0.0;
  for (const Eigen::Vector3d& p : map.points) {
    sum += std::abs(p.z() - scene.Height(p.x(), p.y(), 0));
  }
  EXPECT_LT(sum / static_cast<double>(map.size()), 0.5e-3);
}

TEST_F(MapExportTest, CameraPoseLeadsFromOneFrameToTheOther) {
  const MapSnapshot map = ExportMap(*slam_, MapFrame::kMap);
  const MapSnapshot camera = ExportMap(*slam_, MapFrame::kCamera);
  const CameraPose map_from_camera = ExportCameraPose(*slam_);
  EXPECT_LT((map_from_camera.translation - BumpyScene().CameraPosition(1)).norm(), 0.4e-3);
  ASSERT_EQ(camera.size(), map.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_LT((map_from_camera * camera.points[i] - map.points[i]).norm(), 1e-12);
    EXPECT_LT((map_from_camera.rotation * camera.normals[i] - map.normals[i]).norm(), 1e-12);
  }
}

TEST_F(MapExportTest, LivePointsAreThoseOfTheCameraFrame) {
  const MapSnapshot camera = ExportMap(*slam_, MapFrame::kCamera);
  const std::vector<LivePoint> live = ExportLivePoints(*slam_);
  ASSERT_EQ(live.size(), camera.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    EXPECT_EQ(live[i].position, camera.points[i].cast<float>());
    EXPECT_EQ(live[i].id, camera.ids[i]);
    EXPECT_EQ(live[i].birth_frame, camera.birth_frames[i]);
  }
}

TEST_F(MapExportTest, TheWarpHasTheGraphInMetres) {
  const Warp warp = ExportWarp(*slam_);
  const DeformableMap& map = slam_->map();
  ASSERT_EQ(warp.graph.num_nodes(), map.graph().num_nodes());
  EXPECT_EQ(warp.graph.num_edges(), map.graph().num_edges());
  EXPECT_EQ(warp.state.num_nodes(), map.state().num_nodes());
  EXPECT_EQ(warp.graph.position(0), slam_->unit() * map.graph().position(0));
  // The sheet is 0.1 m away.
  EXPECT_NEAR(warp.graph.position(0).z(), 0.1, 0.03);
}

}  // namespace
}  // namespace ceres_ed
