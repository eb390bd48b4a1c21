#include "ceres_ed/slam/frame/map_growth.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>
#include <test/slam/map_edits.h>

namespace ceres_ed {
namespace {

// The map stores each component of a normal to half of 1 / 32767; strain may double the error.
constexpr double kNormalError = 1.8 / 32767.0;

ObservedSurface Observe(const DepthImage& depth) {
  return ObservedSurface(depth, SmallCamera(), 1.0, ObservedSurfaceOptions());
}

ObservedSurface ObserveHills(const CameraPose& camera_from_map) {
  HillScene scene;
  scene.camera_from_map = camera_from_map;
  return Observe(RenderDepth(SmallCamera(), scene));
}

// Returns the points in view of the map's own camera.
std::vector<VisiblePoint> Visible(const DeformableMap& map) {
  return FindVisible(map, map.state().camera_from_map, SmallCamera(), {});
}

MapGrowthResult Grow(const ObservedSurface& surface, int frame, DeformableMap* map) {
  return GrowMap(Visible(*map), surface, ColorImage(), frame, MapGrowthOptions(), map);
}

Eigen::Vector3d WarpedPoint(const DeformableMap& map, int slot) {
  const PointBinding binding = map.binding(slot);
  return WarpPoint(map.graph(), map.state(), binding, map.point(slot).position);
}

// Returns a new map of the hills, seen from a place that is not the origin.
DeformableMap FirstMap() {
  DeformableMap map;
  map.SetCamera(Motion(0.1, {1.0, 2.0, 0.0}, {0.3, -0.2, 0.1}));
  const ObservedSurface surface = ObserveHills(map.state().camera_from_map);
  const MapGrowthResult grown = Grow(surface, 1, &map);
  EXPECT_EQ(grown.new_points, map.num_points());
  EXPECT_EQ(grown.new_nodes, map.graph().num_nodes());
  EXPECT_GT(grown.new_points, 1000);
  EXPECT_GT(grown.new_nodes, 60);
  return map;
}

bool IsConnected(const DeformationGraph& graph) {
  std::set<int> reached = {0};
  std::vector<int> open = {0};
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    for (const int e : graph.incident_edges(node)) {
      for (const int other : {graph.edges()[e].from, graph.edges()[e].to}) {
        if (reached.insert(other).second) open.push_back(other);
      }
    }
  }
  return static_cast<int>(reached.size()) == graph.num_nodes();
}

TEST(GrowMap, CoversWhatIsSeenWithPointsOneSpacingApart) {
  const DeformableMap map = FirstMap();
  const CameraPose& camera_from_map = map.state().camera_from_map;
  const ObservedSurface surface = ObserveHills(camera_from_map);
  const double spacing = MapGrowthOptions().point_spacing;
  std::vector<Eigen::Vector3d> points;
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    points.push_back(camera_from_map * WarpedPoint(map, slot));
  }
  int checked = 0;
  // Every patch (none is seen at too grazing an angle) has a point within the spacing, as seen in
  // the picture.
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      if (!patch.valid()) continue;
      ++checked;
      const Eigen::Vector2d pixel = SmallCamera().Project(patch.point);
      const bool covered = std::any_of(points.begin(), points.end(), [&](const auto& x) {
        return (SmallCamera().Project(x) - pixel).norm() <= spacing * 120.0 / x.z() + 1e-9;
      });
      EXPECT_TRUE(covered) << pixel.transpose();
    }
  }
  // The window of the last patch is cut off at the corner.
  EXPECT_EQ(checked, 80 * 60 - 1);
  // A disc of the picture with radius f s / z around a point: everything seen outside of it is
  // farther away than s times the cosine of its angle to the axis. There is no rounding to pixels,
  // because the points are at pixels.
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = a + 1; b < points.size(); ++b) {
      const double cosine = points[b].z() / points[b].norm();
      EXPECT_GT((points[a] - points[b]).norm(), spacing * cosine - 1e-9);
    }
  }
}

TEST(GrowMap, PutsNodesWherePointsNeedThem) {
  const DeformableMap map = FirstMap();
  const double coverage = MapGrowthOptions().node_coverage;
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    double nearest = 1e9;
    for (int j = 0; j < map.graph().num_nodes(); ++j) {
      nearest = std::min(nearest, (map.NodePosition(j) - WarpedPoint(map, slot)).norm());
    }
    EXPECT_LE(nearest, coverage + 1e-12);
    // The point is bound to the nodes nearest to it, with the nearest one first.
    EXPECT_NEAR((map.NodePosition(map.binding(slot).nodes[0]) - WarpedPoint(map, slot)).norm(),
                nearest,
                1e-12);
  }
  for (int a = 0; a < map.graph().num_nodes(); ++a) {
    for (int b = 0; b < a; ++b) {
      EXPECT_GT((map.NodePosition(a) - map.NodePosition(b)).norm(), coverage);
    }
  }
}

TEST(GrowMap, MakesOneGraphOfOneSurface) {
  const DeformableMap map = FirstMap();
  EXPECT_TRUE(IsConnected(map.graph()));
  std::set<std::pair<int, int>> edges;
  for (const GraphEdge& e : map.graph().edges()) {
    EXPECT_TRUE(edges.insert({e.from, e.to}).second) << "twice: " << e.from << " " << e.to;
    EXPECT_EQ(e.weight, 1.0);
  }
  for (const auto& edge : edges) EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
}

TEST(GrowMap, StartsAtRest) {
  const DeformableMap map = FirstMap();
  for (int j = 0; j < map.graph().num_nodes(); ++j) {
    EXPECT_LT((NodeAffine(map.state().node(j)) - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_LT(NodeTranslation(map.state().node(j)).norm(), 1e-14);
  }
}

TEST(GrowMap, AddsNothingToAViewThatItHasCovered) {
  DeformableMap map = FirstMap();
  const ObservedSurface surface = ObserveHills(map.state().camera_from_map);
  const int points = map.num_points();
  const MapGrowthResult again = Grow(surface, 2, &map);
  EXPECT_EQ(again.new_points, 0);
  EXPECT_EQ(again.new_nodes, 0);
  EXPECT_EQ(map.num_points(), points);
}

TEST(GrowMap, AddsNothingAgainToASteepPlane) {
  const ObservedSurface surface = Observe(RenderDepth(SmallCamera(), TiltedPlane(6.0, 66.0, 90.0)));
  DeformableMap map;
  const MapGrowthResult first = Grow(surface, 1, &map);
  EXPECT_GT(first.new_points, 300);
  EXPECT_EQ(Grow(surface, 2, &map).new_points, 0);
}

TEST(GrowMap, LeavesGrazingPatchesUntilTheyAreSeenBetter) {
  const PlaneScene plane = TiltedPlane(6.0, 70.0, 0.0);
  const ObservedSurface surface = Observe(RenderDepth(SmallCamera(), plane));
  DeformableMap map;
  Grow(surface, 1, &map);
  const double limit = std::cos(75.0 * M_PI / 180.0);
  int grazing = 0;
  for (int j = 0; j < surface.height(); ++j) {
    for (int i = 0; i < surface.width(); ++i) {
      const SurfacePatch& patch = surface.patch(i, j);
      grazing += patch.valid() && -patch.normal.dot(patch.point.normalized()) < limit;
    }
  }
  EXPECT_GT(grazing, 100);
  EXPECT_GT(map.num_points(), 100);
  for (int slot = 0; slot < map.num_slots(); ++slot) {
    const Eigen::Vector3d x = map.point(slot).birth_position;
    EXPECT_GE(-plane.normal.dot(x.normalized()), limit - 1e-4);
  }
}

// A map that has deformed since, under a camera that has moved on; new points and nodes are added.
class GrowDeformedMap : public ::testing::Test {
 protected:
  GrowDeformedMap() {
    Random random(8);
    for (int j = 0; j < map_.graph().num_nodes(); ++j) {
      EditNode(&map_, j, [&](double* parameters) {
        for (int i = 0; i < kNodeSize; ++i) parameters[i] += 0.03 * random.Gaussian();
      });
    }
    map_.SetCamera(Motion(0.15, {1.0, 2.0, 0.0}, {-2.2, 0.6, 0.1}));
    old_nodes_ = map_.graph().num_nodes();
    visible_ = Visible(map_);
    before_ = map_;
    surface_ = std::make_unique<ObservedSurface>(ObserveHills(map_.state().camera_from_map));
    result_ = GrowMap(visible_, *surface_, ColorImage(), 2, MapGrowthOptions(), &map_);
  }

  DeformableMap map_ = FirstMap();
  DeformableMap before_;
  int old_nodes_ = 0;
  std::vector<VisiblePoint> visible_;
  std::unique_ptr<ObservedSurface> surface_;
  MapGrowthResult result_;
};

TEST_F(GrowDeformedMap, PutsNewPointsWhereTheyAreSeen) {
  const CameraPose& camera_from_map = map_.state().camera_from_map;
  ASSERT_GT(result_.new_points, 200);
  int checked = 0;
  for (int slot = 0; slot < map_.num_slots(); ++slot) {
    const MapPoint point = map_.point(slot);
    const PointBinding binding = map_.binding(slot);
    if (point.birth_frame != 2) continue;
    ++checked;
    const SurfacePatch* patch = surface_->Find(SmallCamera().Project(point.birth_position));
    ASSERT_NE(patch, nullptr);
    EXPECT_LT((camera_from_map * WarpedPoint(map_, slot) - patch->point).norm(), 1e-12);
    // The value as the map stores it.
    EXPECT_EQ(point.birth_position, patch->point.cast<float>().cast<double>());
    const Eigen::Vector3d normal =
        camera_from_map.rotation * WarpNormal(map_.state(), binding, point.normal);
    EXPECT_LT((normal - patch->normal).norm(), kNormalError);
    EXPECT_NEAR(point.normal.norm(), 1.0, kNormalError);
    EXPECT_EQ(point.weight, 1.0);
  }
  EXPECT_EQ(checked, result_.new_points);
}

TEST_F(GrowDeformedMap, PutsNewNodesOnTheSurfaceThatAskedForThem) {
  ASSERT_GT(result_.new_nodes, 10);
  EXPECT_EQ(map_.graph().num_nodes(), old_nodes_ + result_.new_nodes);
  for (int j = old_nodes_; j < map_.graph().num_nodes(); ++j) {
    const Eigen::Vector3d x = map_.state().camera_from_map * map_.NodePosition(j);
    const SurfacePatch* patch = surface_->Find(SmallCamera().Project(x));
    ASSERT_NE(patch, nullptr);
    EXPECT_LT((x - patch->point).norm(), 1e-12);
    // The node starts with the rotation of the nodes near it, without their strain.
    const Eigen::Matrix3d affine = NodeAffine(map_.state().node(j));
    EXPECT_GT((affine - Eigen::Matrix3d::Identity()).norm(), 1e-3);
    EXPECT_LT((affine.transpose() * affine - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_GT(affine.determinant(), 0.0);
    for (int other = 0; other < j; ++other) {
      EXPECT_GT((map_.NodePosition(j) - map_.NodePosition(other)).norm(), 1.0);
    }
  }
  EXPECT_TRUE(IsConnected(map_.graph()));
}

TEST_F(GrowDeformedMap, LeavesOldPointsAndNodesInTheirPlaces) {
  int rebound = 0;
  for (const VisiblePoint& seen : visible_) {
    EXPECT_LT((WarpedPoint(map_, seen.slot) - seen.in_map).norm(), 1e-12);
    const PointBinding binding = map_.binding(seen.slot);
    EXPECT_LT((WarpNormal(map_.state(), binding, map_.point(seen.slot).normal) - seen.normal_in_map)
                  .norm(),
              kNormalError);
    rebound += std::any_of(
        binding.nodes, binding.nodes + binding.size, [&](int node) { return node >= old_nodes_; });
  }
  EXPECT_GT(rebound, 20);
  std::set<int> in_view;
  for (const VisiblePoint& seen : visible_) in_view.insert(seen.slot);
  for (int slot = 0; slot < before_.num_slots(); ++slot) {
    EXPECT_EQ(map_.point(slot).id, before_.point(slot).id);
    if (in_view.count(slot) != 0) continue;
    EXPECT_EQ(map_.point(slot).position, before_.point(slot).position);
    EXPECT_EQ(map_.binding(slot).nodes[0], before_.binding(slot).nodes[0]);
  }
  for (int j = 0; j < old_nodes_; ++j) {
    EXPECT_EQ(map_.graph().position(j), before_.graph().position(j));
    EXPECT_TRUE(std::equal(
        map_.state().node(j), map_.state().node(j) + kNodeSize, before_.state().node(j)));
  }
}

}  // namespace
}  // namespace ceres_ed
