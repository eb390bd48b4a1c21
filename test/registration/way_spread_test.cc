#include "ceres_ed/registration/uncertainty/way_spread.h"

#include <vector>

#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

// One node that carries two points.
BuiltGraph OneNode() {
  BuiltGraph graph;
  graph.graph.AddNode({0.0, 0.0, 0.0});
  graph.skinning = Skinning(1);
  const int node = 0;
  const double weight = 1.0;
  for (int p = 0; p < 2; ++p) graph.skinning.Add(&node, &weight, 1);
  return graph;
}

DeformationState MovedBy(const Eigen::Vector3d& offset) {
  DeformationState state(1);
  MutableNodeTranslation(state.node(0)) = offset;
  return state;
}

TEST(WaySpread, IsNothingWithoutAnotherWay) {
  EXPECT_EQ(WaySpread().About(Eigen::Vector3d(1, 2, 3), 0), Eigen::Matrix3d::Zero());
}

TEST(WaySpread, IsTheMeanOuterProductOfTheDistances) {
  const std::vector<Eigen::Vector3d> points = {{0.5, 0.0, 0.0}, {0.0, 0.5, 0.0}};
  const BuiltGraph graph = OneNode();
  WaySpread ways;
  ways.Add(points, graph, MovedBy({0.1, 0.0, 0.0}), 1);
  ways.Add(points, graph, MovedBy({0.0, 0.0, 0.2}), 1);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(0, 0) = 0.005;
  expected(2, 2) = 0.02;
  EXPECT_TRUE(ways.About(points[1], 1).isApprox(expected, 1e-12));
}

}  // namespace
}  // namespace ceres_ed
