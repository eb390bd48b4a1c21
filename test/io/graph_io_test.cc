#include "ceres_ed/io/graph_io.h"

#include "io_test_util.h"

#include <ceres_ed/io/cloud_io.h>

#include <cmath>
#include <string>

#include <cost_functions/node_parameters.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(WriteGraph, HoldsDeformedNodesRestPositionsAndEdges) {
  const TemporaryDirectory directory;
  DeformationGraph graph;
  graph.AddNode({1, 0, 0});
  graph.AddNode({0, 2, 0});
  graph.AddEdge({0, 1, 0.25});
  graph.AddEdge({1, 0, 0.5});
  DeformationState state(2);
  MutableNodeTranslation(state.node(1)) = Eigen::Vector3d(0, 0, 3);
  GraphWriteOptions options;
  options.format = PlyFormat::kAscii;
  options.is_point_relevant = {false, true};
  // Scaled by two, turned by 90 degrees about z (x to y), then moved by 10 along x.
  options.output_from_graph.scale = 2.0;
  options.output_from_graph.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ()));
  options.output_from_graph.translation = {10, 0, 0};
  const std::string path = directory / "graph.ply";
  ASSERT_TRUE(WriteGraph(path, graph, state, options).ok());

  const StatusOr<LoadedCloud> loaded = LoadCloud(path);
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  // The file has floats, whose spacing at 10 is 1e-6.
  EXPECT_LT((loaded->cloud.points[0] - Eigen::Vector3d(10, 2, 0)).norm(), 1e-6);
  EXPECT_LT((loaded->cloud.points[1] - Eigen::Vector3d(6, 0, 6)).norm(), 1e-6);
  const PlyElement& nodes = *loaded->document.Find("vertex");
  EXPECT_THAT(nodes.Find("pr")->values, ElementsAre(0, 1));
  EXPECT_EQ(nodes.Find("pr")->type, PlyType::kInt32);
  EXPECT_THAT(nodes.Find("rest_x")->values, ElementsAre(1, 0));
  EXPECT_THAT(nodes.Find("rest_y")->values, ElementsAre(0, 2));
  EXPECT_THAT(nodes.Find("rest_z")->values, ElementsAre(0, 0));
  const PlyElement& edges = *loaded->document.Find("edge");
  EXPECT_THAT(edges.Find("vertex1")->values, ElementsAre(0, 1));
  EXPECT_THAT(edges.Find("vertex2")->values, ElementsAre(1, 0));
  EXPECT_THAT(edges.Find("alpha")->values, ElementsAre(0.25, 0.5));
  EXPECT_EQ(edges.Find("alpha")->type, PlyType::kFloat32);
}

TEST(WriteGraph, ColorsPrAndPiNodesApartWhereAsked) {
  const TemporaryDirectory directory;
  DeformationGraph graph;
  for (int j = 0; j < 3; ++j) graph.AddNode(Eigen::Vector3d(j, 0, 0));
  GraphWriteOptions options;
  options.is_point_relevant = {true, false, true};
  options.with_colors = true;
  ASSERT_TRUE(WriteGraph(directory / "graph.ply", graph, DeformationState(3), options).ok());
  const StatusOr<LoadedCloud> loaded = LoadCloud(directory / "graph.ply");
  ASSERT_TRUE(loaded.ok()) << loaded.status().message();
  const PlyElement& nodes = *loaded->document.Find("vertex");
  EXPECT_THAT(nodes.Find("pr")->values, ElementsAre(1, 0, 1));
  EXPECT_THAT(nodes.Find("red")->values, ElementsAre(240, 40, 240));
  EXPECT_THAT(nodes.Find("green")->values, ElementsAre(140, 90, 140));
  EXPECT_THAT(nodes.Find("blue")->values, ElementsAre(20, 200, 20));
  EXPECT_EQ(nodes.Find("red")->type, PlyType::kUint8);
}

TEST(WriteGraph, MissingDirectoryIsAnError) {
  const TemporaryDirectory directory;
  DeformationGraph graph;
  graph.AddNode({1, 0, 0});
  EXPECT_THAT(WriteGraph(directory / "no/g.ply", graph, DeformationState(1)).message(),
              HasSubstr("g.ply: cannot write: No such file"));
}

}  // namespace
}  // namespace ceres_ed
