#include "ceres_ed/slam/frame/visibility.h"

#include <ceres_ed/util/random.h>

#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <test/slam/depth_scenes.h>
#include <test/slam/map_edits.h>

namespace ceres_ed {
namespace {

const Eigen::Vector3d kTowardCamera(0.0, 0.0, -1.0);

// Adds a point that is bound to one node.
int AddPoint(const Eigen::Vector3d& at_rest,
             const Eigen::Vector3d& normal,
             int node,
             DeformableMap* map) {
  MapPoint point;
  point.position = at_rest;
  point.normal = normal;
  const double weight = 1.0;
  return map->AddPoint(point, {&node, &weight, 1});
}

// Adds a square of points 0.15 apart that face along `normal`, bound to a node at its middle.
std::vector<int> AddSquare(const Eigen::Vector3d& center,
                           double side,
                           const Eigen::Vector3d& normal,
                           DeformableMap* map) {
  const int node = map->AddNode(center, center, Eigen::Matrix3d::Identity());
  std::vector<int> slots;
  const int half = static_cast<int>(std::floor(0.5 * side / 0.15));
  for (int i = -half; i <= half; ++i) {
    for (int j = -half; j <= half; ++j) {
      slots.push_back(AddPoint(center + 0.15 * Eigen::Vector3d(i, j, 0.0), normal, node, map));
    }
  }
  return slots;
}

std::set<int> VisibleSlots(const DeformableMap& map,
                           const CameraPose& camera_from_map = {},
                           const VisibilityOptions& options = {}) {
  std::set<int> slots;
  for (const VisiblePoint& p : FindVisible(map, camera_from_map, SmallCamera(), options)) {
    EXPECT_TRUE(slots.insert(p.slot).second) << "twice: " << p.slot;
  }
  return slots;
}

TEST(FindVisible, FindsNothingInAnEmptyMap) { EXPECT_TRUE(VisibleSlots(DeformableMap()).empty()); }

TEST(FindVisible, HidesWhatIsBehindAWall) {
  DeformableMap map;
  const std::vector<int> back = AddSquare({0.0, 0.0, 6.0}, 4.0, kTowardCamera, &map);
  const std::vector<int> wall = AddSquare({0.0, 0.0, 4.0}, 1.2, kTowardCamera, &map);
  const std::set<int> visible = VisibleSlots(map);
  for (const int slot : wall) EXPECT_EQ(visible.count(slot), 1u);
  // The shadow of the wall at z = 6 is 0.9 wide to each side. A cell of the z-buffer is 0.3 wide at
  // the median depth of the scene, 6; within this distance of the shadow's rim a point may be
  // visible or hidden.
  int hidden = 0;
  for (const int slot : back) {
    const Eigen::Vector3d x = map.point(slot).position;
    const double off_axis = std::max(std::abs(x.x()), std::abs(x.y()));
    if (off_axis < 0.9 - 0.3) {
      EXPECT_EQ(visible.count(slot), 0u) << x.transpose();
      ++hidden;
    } else if (off_axis > 0.9 + 0.3) {
      EXPECT_EQ(visible.count(slot), 1u) << x.transpose();
    }
  }
  EXPECT_GE(hidden, 49);
}

TEST(FindVisible, HidesNothingThatIsBehindByLessThanTheTolerance) {
  DeformableMap map;
  const std::vector<int> front = AddSquare({0.0, 0.0, 4.0}, 1.2, kTowardCamera, &map);
  const std::vector<int> back = AddSquare({0.0, 0.0, 4.49}, 1.2, kTowardCamera, &map);
  EXPECT_EQ(VisibleSlots(map).size(), front.size() + back.size());
  VisibilityOptions options;
  options.depth_tolerance = 0.48;
  EXPECT_LT(VisibleSlots(map, {}, options).size(), front.size() + back.size());
}

TEST(FindVisible, LeavesOutWhatLooksAway) {
  DeformableMap map;
  const int node = map.AddNode({0.0, 0.0, 4.0}, {0.0, 0.0, 4.0}, Eigen::Matrix3d::Identity());
  const auto facing = [&](double degrees) {
    const double angle = degrees * M_PI / 180.0;
    return AddPoint({0.0, 0.0, 4.0}, {std::sin(angle), 0.0, -std::cos(angle)}, node, &map);
  };
  const int straight = facing(0.0);
  const int grazing = facing(84.9);
  facing(85.1);
  facing(-85.1);
  facing(180.0);
  EXPECT_EQ(VisibleSlots(map), (std::set<int>{straight, grazing}));
  // Seen from behind, the other side is in view.
  const CameraPose behind = Motion(M_PI, Eigen::Vector3d::UnitY(), {0.0, 0.0, 8.0});
  EXPECT_EQ(VisibleSlots(map, behind).size(), 1u);
}

TEST(FindVisible, LeavesOutWhatIsBesideThePictureOrBehindTheCamera) {
  DeformableMap map;
  const int node = map.AddNode({0.0, 0.0, 2.0}, {0.0, 0.0, 2.0}, Eigen::Matrix3d::Identity());
  const auto at_pixel = [&](double u, double v) {
    const Eigen::Vector3d x = SmallCamera().BackProject(u, v, 2.0);
    return AddPoint(x, -x.normalized(), node, &map);
  };
  std::set<int> inside;
  for (const double u : {-0.49, 159.49}) {
    for (const double v : {-0.49, 119.49}) inside.insert(at_pixel(u, v));
  }
  at_pixel(-0.51, 60.0);
  at_pixel(159.51, 60.0);
  at_pixel(80.0, -0.51);
  at_pixel(80.0, 119.51);
  AddPoint({0.0, 0.0, -0.5}, {0.0, 0.0, 1.0}, node, &map);
  AddPoint({0.0, 0.0, -0.5}, {0.0, 0.0, -1.0}, node, &map);
  AddPoint({0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, node, &map);
  EXPECT_EQ(VisibleSlots(map), inside);
}

// A surface does not hide itself, however steep it is seen.
TEST(FindVisible, SeesAllOfASteepPlane) {
  for (const double slope : {50.0, 65.0, 74.0}) {
    const PlaneScene plane = TiltedPlane(6.0, slope, 0.0);
    const Eigen::Vector3d along = plane.normal.cross(Eigen::Vector3d::UnitY());
    DeformableMap map;
    const int node = map.AddNode(plane.point, plane.point, Eigen::Matrix3d::Identity());
    std::set<int> all;
    for (int i = -10; i <= 10; ++i) {
      for (int j = -10; j <= 10; ++j) {
        const Eigen::Vector3d x =
            plane.point + 0.1 * i * along + 0.1 * j * Eigen::Vector3d::UnitY();
        all.insert(AddPoint(x, plane.normal, node, &map));
      }
    }
    EXPECT_EQ(VisibleSlots(map), all) << slope;
  }
}

// Nodes on all sides of the camera, near and far, each with points as far from it as its reach.
TEST(FindVisible, LosesNoPointByCullingNodes) {
  const PinholeCamera wide = {70.0, 70.0, 79.5, 59.5, 160, 120};
  const CameraPose camera_from_map = Motion(0.7, {1.0, 2.0, -1.0}, {0.5, -0.3, 1.0});
  Random random(11);
  const auto in_ball = [&random](double radius) {
    Eigen::Vector3d x;
    do {
      for (int i = 0; i < 3; ++i) x[i] = 2.0 * random.Uniform() - 1.0;
    } while (x.norm() > 1.0);
    return Eigen::Vector3d(radius * x);
  };
  DeformableMap map;
  for (int k = 0; k < 3000; ++k) {
    const Eigen::Vector3d place = in_ball(k % 3 == 0 ? 6.0 : 25.0);
    const int node = map.AddNode(in_ball(5.0), place, Eigen::Matrix3d::Identity());
    for (int p = 0; p < 5; ++p) {
      AddPoint(map.graph().position(node) + in_ball(p == 0 ? 1.0 : 2.99),
               in_ball(1.0).normalized(),
               node,
               &map);
    }
  }
  VisibilityOptions options;
  options.depth_tolerance = 1e9;
  for (const PinholeCamera& camera : {SmallCamera(), wide}) {
    std::set<int> expected;
    for (int slot = 0; slot < map.num_slots(); ++slot) {
      const int node = map.binding(slot).nodes[0];
      const Eigen::Vector3d x =
          camera_from_map *
          (map.point(slot).position + Eigen::Vector3d(NodeTranslation(map.state().node(node))));
      if (x.z() <= 0.0) continue;
      const double u = camera.fx * x.x() / x.z() + camera.cx;
      const double v = camera.fy * x.y() / x.z() + camera.cy;
      if (u < -0.5 || v < -0.5 || u >= 159.5 || v >= 119.5) continue;
      const Eigen::Vector3d n = camera_from_map.rotation * map.point(slot).normal;
      if (-n.dot(x) < std::cos(85.0 * M_PI / 180.0) * x.norm()) continue;
      expected.insert(slot);
    }
    std::set<int> found;
    for (const VisiblePoint& p : FindVisible(map, camera_from_map, camera, options)) {
      found.insert(p.slot);
    }
    EXPECT_GT(expected.size(), 200u);
    EXPECT_EQ(found, expected);
  }
}

TEST(UpdateVisible, FollowsNodesAndCamera) {
  DeformableMap map;
  AddSquare({0.0, 0.0, 4.0}, 1.2, kTowardCamera, &map);
  std::vector<VisiblePoint> points = FindVisible(map, {}, SmallCamera(), {});
  ASSERT_EQ(points.size(), 81u);
  // The warp x -> B (x - g) + g + t of the single node.
  const Eigen::Matrix3d B =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 1.0, 0.0).normalized()).toRotationMatrix();
  const Eigen::Vector3d t(0.2, -0.1, 0.5);
  EditNode(&map, 0, [&](double* parameters) {
    MutableNodeAffine(parameters) = B;
    MutableNodeTranslation(parameters) = t;
  });
  const CameraPose camera = Motion(0.1, {0.0, 1.0, 0.0}, {0.3, 0.0, 0.2});
  UpdateVisible(map, camera, SmallCamera(), &points);
  ASSERT_EQ(points.size(), 81u);
  const Eigen::Vector3d g(0.0, 0.0, 4.0);
  for (const VisiblePoint& p : points) {
    const Eigen::Vector3d x = B * (map.point(p.slot).position - g) + g + t;
    EXPECT_LT((p.in_map - x).norm(), 1e-14);
    EXPECT_LT((p.normal_in_map - B * kTowardCamera).norm(), 1e-14);
    EXPECT_LT((p.in_camera - camera * x).norm(), 1e-14);
    EXPECT_LT((p.pixel - SmallCamera().Project(camera * x)).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace ceres_ed
