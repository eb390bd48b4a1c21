#include "ceres_ed/slam/map/deformable_map.h"

#include <ceres_ed/graph/warp.h>
#include <ceres_ed/util/random.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

Eigen::Vector3d RandomVector(double size, Random* random) {
  Eigen::Vector3d x;
  for (int i = 0; i < 3; ++i) x[i] = size * random->Gaussian();
  return x;
}

Eigen::Matrix3d RandomAffine(Random* random) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 9; ++i) A(i) += 0.2 * random->Gaussian();
  return A;
}

int Pick(int count, Random* random) {
  return std::min(count - 1, static_cast<int>(count * random->Uniform()));
}

// A binding that owns its memory.
struct OwnBinding {
  std::vector<int> nodes;
  std::vector<double> weights;

  Binding Get() const { return {nodes.data(), weights.data(), static_cast<int>(nodes.size())}; }
};

// Returns a binding to up to four of `num_nodes` nodes, each at most once.
OwnBinding RandomBinding(int num_nodes, Random* random) {
  OwnBinding binding;
  double sum = 0.0;
  for (int k = 1 + Pick(4, random); k > 0; --k) {
    const int node = Pick(num_nodes, random);
    if (std::count(binding.nodes.begin(), binding.nodes.end(), node) != 0) continue;
    binding.nodes.push_back(node);
    binding.weights.push_back(random->Uniform());
    sum += binding.weights.back();
  }
  for (double& weight : binding.weights) weight /= sum;
  return binding;
}

DeformableMap RandomNodes(int count, Random* random) {
  DeformableMap map;
  for (int j = 0; j < count; ++j) {
    map.AddNode(RandomVector(5.0, random), RandomVector(5.0, random), RandomAffine(random));
  }
  return map;
}

TEST(DeformableMap, PutsANodeWhereItIsNow) {
  Random random(1);
  DeformableMap map;
  for (int j = 0; j < 5; ++j) {
    const Eigen::Vector3d at_rest = RandomVector(3.0, &random);
    const Eigen::Vector3d now = RandomVector(3.0, &random);
    const Eigen::Matrix3d affine = RandomAffine(&random);
    ASSERT_EQ(map.AddNode(at_rest, now, affine), j);
    EXPECT_EQ(map.graph().position(j), at_rest);
    EXPECT_EQ(NodeAffine(map.state().node(j)), affine);
    EXPECT_LT((map.NodePosition(j) - now).norm(), 1e-14);
    EXPECT_TRUE(map.points_of_node(j).empty());
    EXPECT_EQ(map.node_prior(j), now - at_rest);
  }
  EXPECT_EQ(map.state().num_nodes(), 5);
}

// The expected contents of the map: for each used slot the identifier and the strongest node of its
// point.
struct Model {
  std::map<int, std::pair<int, int>> slots;
  std::set<int> ids;

  void ExpectIn(const DeformableMap& map) const {
    ASSERT_EQ(map.num_points(), static_cast<int>(slots.size()));
    std::vector<std::set<int>> owned(map.graph().num_nodes());
    for (int slot = 0; slot < map.num_slots(); ++slot) {
      const auto entry = slots.find(slot);
      ASSERT_EQ(map.alive(slot), entry != slots.end()) << slot;
      if (entry == slots.end()) continue;
      EXPECT_EQ(map.point(slot).id, entry->second.first);
      EXPECT_EQ(map.binding(slot).nodes[0], entry->second.second);
      owned[entry->second.second].insert(slot);
    }
    for (int j = 0; j < map.graph().num_nodes(); ++j) {
      const std::vector<int>& points = map.points_of_node(j);
      EXPECT_EQ(std::set<int>(points.begin(), points.end()), owned[j]);
      EXPECT_EQ(points.size(), owned[j].size());
    }
  }
};

TEST(DeformableMap, KeepsItsBooksThroughAddingRemovingAndRebinding) {
  Random random(2);
  DeformableMap map = RandomNodes(20, &random);
  Model model;
  int most = 0;
  for (int step = 0; step < 2000; ++step) {
    const double dice = random.Uniform();
    if (model.slots.empty() || dice < 0.45) {
      const OwnBinding binding = RandomBinding(20, &random);
      MapPoint point;
      // The identifier that the caller sets is ignored.
      point.id = 3;
      point.position = RandomVector(2.0, &random);
      const int slot = map.AddPoint(point, binding.Get());
      ASSERT_EQ(model.slots.count(slot), 0u);
      EXPECT_EQ(map.point(slot).position, point.position);
      ASSERT_TRUE(model.ids.insert(map.point(slot).id).second) << "an id was used again";
      EXPECT_EQ(map.point(slot).id, static_cast<int>(model.ids.size()) - 1);
      model.slots[slot] = {map.point(slot).id, binding.nodes[0]};
    } else {
      auto entry = model.slots.begin();
      std::advance(entry, Pick(static_cast<int>(model.slots.size()), &random));
      if (dice < 0.8) {
        map.RemovePoint(entry->first);
        model.slots.erase(entry);
      } else {
        const OwnBinding binding = RandomBinding(20, &random);
        map.Rebind(entry->first, binding.Get());
        const PointBinding now = map.binding(entry->first);
        const PointBinding kept = MapPoints::Kept(binding.Get());
        ASSERT_EQ(now.size, static_cast<int>(binding.nodes.size()));
        EXPECT_TRUE(std::equal(now.nodes, now.nodes + now.size, binding.nodes.begin()));
        EXPECT_TRUE(std::equal(now.weights, now.weights + now.size, kept.weights));
        entry->second.second = binding.nodes[0];
      }
    }
    most = std::max(most, static_cast<int>(model.slots.size()));
    // The slots of removed points are used again before new slots are added.
    ASSERT_EQ(map.num_slots(), most);
    if (step % 50 == 0) model.ExpectIn(map);
  }
  model.ExpectIn(map);
  EXPECT_GT(model.ids.size(), 2u * most);
}

TEST(DeformableMapDeathTest, RemovesNoPointTwice) {
  Random random(3);
  DeformableMap map = RandomNodes(2, &random);
  const int slot = map.AddPoint(MapPoint(), RandomBinding(2, &random).Get());
  map.RemovePoint(slot);
  EXPECT_DEATH(map.RemovePoint(slot), "slot 0");
}

TEST(DeformableMap, WarpsABindingAsTheGraphDoes) {
  Random random(4);
  const DeformableMap map = RandomNodes(12, &random);
  for (int k = 0; k < 50; ++k) {
    const OwnBinding binding = RandomBinding(12, &random);
    const LocalWarp warp = map.WarpOf(binding.Get());
    EXPECT_LT((warp.gradient - WarpGradient(map.state(), binding.Get())).norm(), 1e-14);
    const Eigen::Vector3d x = RandomVector(5.0, &random);
    EXPECT_LT((warp * x - WarpPoint(map.graph(), map.state(), binding.Get(), x)).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace ceres_ed
