#include <ceres_ed/registration/moving_samples.h>

#include <cmath>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

// Returns a state in which each node has the affine map diag(x, y, 1).
DeformationState Scaled(int num_nodes, double x, double y) {
  DeformationState state(num_nodes);
  for (int j = 0; j < num_nodes; ++j) {
    MutableNodeAffine(state.node(j)) = Eigen::Vector3d(x, y, 1.0).asDiagonal();
  }
  return state;
}

TEST(MovingSamples, LoseTheAreaThatFallsBelowHalf) {
  const Surface sheet(MakeGridMesh(30, 30));
  GraphOptions options;
  options.node_spacing = 6.0;
  const StatusOr<BuiltGraph> graph = BuildGraph(sheet.cloud(), sheet.topology(), options);
  ASSERT_TRUE(graph.ok()) << graph.status().message();
  const MovingSamples samples(sheet, *graph, 500);
  const int nodes = graph->graph.num_nodes();
  EXPECT_EQ(samples.LostArea(DeformationState(nodes)), 0.0);
  EXPECT_EQ(samples.LostArea(Scaled(nodes, 0.6, 1.0)), 0.0);
  EXPECT_EQ(samples.LostArea(Scaled(nodes, 3.0, 1.0)), 0.0);
  EXPECT_NEAR(samples.LostArea(Scaled(nodes, 0.5, 0.5)), 0.5, 1e-12);
  EXPECT_NEAR(samples.LostArea(Scaled(nodes, 0.0, 1.0)), 1.0, 1e-12);
}

TEST(MovingSamples, StretchAsTheLogarithmOfTheirLengths) {
  const Surface sheet(MakeGridMesh(30, 30));
  GraphOptions options;
  options.node_spacing = 6.0;
  const StatusOr<BuiltGraph> graph = BuildGraph(sheet.cloud(), sheet.topology(), options);
  ASSERT_TRUE(graph.ok()) << graph.status().message();
  const MovingSamples samples(sheet, *graph, 500);
  const int nodes = graph->graph.num_nodes();
  EXPECT_NEAR(samples.Stretch(DeformationState(nodes), 0.9), 0.0, 1e-12);
  EXPECT_NEAR(samples.Stretch(Scaled(nodes, 1.3, 0.9), 0.9), std::log(1.3), 1e-12);
  EXPECT_NEAR(samples.Stretch(Scaled(nodes, 1.1, 0.5), 0.9), std::log(2.0), 1e-12);
  EXPECT_NEAR(samples.Stretch(Scaled(nodes, 0.0, 1.0), 0.9), std::log(1000.0), 1e-9);
}

}  // namespace
}  // namespace ceres_ed
