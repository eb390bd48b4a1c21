#include "ceres_ed/graph/volume.h"

#include <ceres_ed/geometry/topology.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/graph_builder.h>
#include <ceres_ed/graph/warp.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

GraphOptions BodyOptions(double spacing) {
  GraphOptions options;
  options.node_spacing = spacing;
  options.volume = true;
  return options;
}

BuiltGraph Build(const PointCloud& cloud, const GraphOptions& options) {
  StatusOr<BuiltGraph> built = BuildGraph(cloud, options);
  CHECK(built.ok()) << built.status().message();
  return *std::move(built);
}

// Two balls side by side, with a gap of 0.1.
PointCloud TwoBalls() {
  const PointCloud ball = MakeSphereMesh(3);
  return Append(ball, ball, {2.1, 0.0, 0.0});
}

TEST(AddVolume, FillsABallWithNodesInside) {
  const PointCloud ball = MakeSphereMesh(3);
  const BuiltGraph built = Build(ball, BodyOptions(0.3));
  const DeformationGraph& graph = built.graph;
  EXPECT_EQ(graph.num_surface_nodes(), static_cast<int>(built.node_points.size()));
  // A ball of the radius 0.76 on a grid of the pitch 0.3 has about 68 nodes.
  EXPECT_GT(graph.num_inner_nodes(), 40);
  EXPECT_LT(graph.num_inner_nodes(), 100);
  for (int j = graph.num_surface_nodes(); j < graph.num_nodes(); ++j) {
    EXPECT_LT(graph.position(j).norm(), 0.95) << j;
    // Three neighbours, in both directions.
    EXPECT_GE(graph.incident_edges(j).size(), 6u) << j;
  }
  EXPECT_GT(graph.num_edges(), built.num_surface_edges);
}

TEST(EnclosesBody, KnowsClosedSurfacesAndThoseWithSmallHoles) {
  PointCloud ball = MakeSphereMesh(3);
  EXPECT_TRUE(EnclosesBody(ball, BuildTopology(ball)));
  ball.triangles.pop_back();
  EXPECT_TRUE(EnclosesBody(ball, BuildTopology(ball)));
  // Half a ball, as a camera sees it.
  PointCloud view = MakeSphereMesh(6);
  const auto& points = view.points;
  view.triangles.erase(
      std::remove_if(view.triangles.begin(),
                     view.triangles.end(),
                     [&points](const auto& triangle) { return points[triangle[0]].z() < 0.0; }),
      view.triangles.end());
  EXPECT_FALSE(EnclosesBody(view, BuildTopology(view)));
  EXPECT_FALSE(EnclosesBody(PointCloud(), BuildTopology(PointCloud())));
}

TEST(AddVolume, HasNoMoreNodesThanACoarseMeshHasRoomFor) {
  // Every vertex is a node; a grid of the wanted pitch would have 10^21 nodes.
  const PointCloud ball = MakeSphereMesh(2);
  const DeformationGraph graph = Build(ball, BodyOptions(1e-7)).graph;
  EXPECT_GT(graph.num_inner_nodes(), 0);
  EXPECT_LT(graph.num_inner_nodes(), 20 * static_cast<int>(ball.size()));
}

TEST(AddVolume, LeavesTheSurfaceAsItIs) {
  const PointCloud ball = MakeSphereMesh(3);
  GraphOptions options = BodyOptions(0.3);
  const BuiltGraph with = Build(ball, options);
  options.volume = false;
  const BuiltGraph without = Build(ball, options);
  EXPECT_EQ(with.node_points, without.node_points);
  EXPECT_EQ(with.num_surface_edges, without.graph.num_edges());
  for (int e = 0; e < without.graph.num_edges(); ++e) {
    EXPECT_EQ(with.graph.edges()[e].to, without.graph.edges()[e].to);
    EXPECT_EQ(with.graph.edges()[e].weight, without.graph.edges()[e].weight);
  }
  for (std::size_t p = 0; p < ball.size(); ++p) {
    ASSERT_EQ(with.skinning[p].size, without.skinning[p].size);
    for (int i = 0; i < with.skinning[p].size; ++i) {
      EXPECT_EQ(with.skinning[p].nodes[i], without.skinning[p].nodes[i]);
    }
  }
}

TEST(AddVolume, NoEdgeLeavesTheBody) {
  const PointCloud balls = TwoBalls();
  GraphOptions options = BodyOptions(0.3);
  options.join_pieces = false;
  const DeformationGraph graph = Build(balls, options).graph;
  ASSERT_GT(graph.num_inner_nodes(), 0);
  for (const GraphEdge& edge : graph.edges()) {
    EXPECT_EQ(graph.position(edge.from).x() > 1.05, graph.position(edge.to).x() > 1.05);
  }
}

TEST(AddVolume, JoinsTheSidesOfALimbThatHasNoRoomForNodes) {
  PointCloud rod = MakeSphereMesh(4);
  for (Eigen::Vector3d& point : rod.points) point.y() *= 0.15, point.z() *= 0.15;
  const BuiltGraph built = Build(rod, BodyOptions(0.3));
  EXPECT_EQ(built.graph.num_inner_nodes(), 0);
  EXPECT_GT(built.graph.num_edges(), built.num_surface_edges);
}

TEST(AddVolume, AnOpenSheetGetsNothing) {
  const BuiltGraph built = Build(MakeGridMesh(21, 21, 0.1), BodyOptions(0.4));
  EXPECT_EQ(built.graph.num_inner_nodes(), 0);
  EXPECT_EQ(built.graph.num_edges(), built.num_surface_edges);
}

TEST(BindInBody, ReproducesAnAffineMapAndIsContinuous) {
  const BuiltGraph built = Build(MakeSphereMesh(3), BodyOptions(0.3));
  const DeformationGraph& graph = built.graph;
  Eigen::Matrix3d A;
  A << 1.1, 0.2, 0.0, -0.1, 0.9, 0.1, 0.0, 0.3, 1.2;
  DeformationState state(graph.num_nodes());
  for (int j = 0; j < graph.num_nodes(); ++j) {
    MutableNodeAffine(state.node(j)) = A;
    MutableNodeTranslation(state.node(j)) = A * graph.position(j) - graph.position(j);
  }
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i <= 2000; ++i) line.emplace_back(-0.9 + 9e-4 * i, 0.05, 0.1);
  const Skinning skinning = BindInBody(line, graph, 1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_LT((WarpPoint(graph, state, skinning[i], line[i]) - A * line[i]).norm(), 1e-12);
  }
  // Weights of neighbours on the line differ by little: nothing tears.
  std::vector<double> before(graph.num_nodes(), 0.0);
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::vector<double> now(graph.num_nodes(), 0.0);
    for (int k = 0; k < skinning[i].size; ++k) {
      now[skinning[i].nodes[k]] = skinning[i].weights[k];
    }
    for (int j = 0; i > 0 && j < graph.num_nodes(); ++j) EXPECT_NEAR(now[j], before[j], 0.02);
    before = std::move(now);
  }
}

TEST(BindInBody, ABodyDoesNotFollowTheOneBesideIt) {
  GraphOptions options = BodyOptions(0.3);
  options.join_pieces = false;
  const BuiltGraph built = Build(TwoBalls(), options);
  const std::vector<Eigen::Vector3d> points = {{0.8, 0.0, 0.0}, {1.3, 0.0, 0.0}};
  const Skinning skinning = BindInBody(points, built.graph, 1);
  for (int p = 0; p < 2; ++p) {
    for (int i = 0; i < skinning[p].size; ++i) {
      EXPECT_EQ(built.graph.position(skinning[p].nodes[i]).x() > 1.05, p == 1);
    }
  }
}

TEST(BindCloudToGraph, BindsTheSurfaceOfABodyAsItWasBuilt) {
  // A crumb of four points inside, which has no node of its own.
  PointCloud body = MakeSphereMesh(3);
  const int first = static_cast<int>(body.size());
  for (const Eigen::Vector3d& offset : {Eigen::Vector3d(0, 0, 0),
                                        Eigen::Vector3d(0.05, 0, 0),
                                        Eigen::Vector3d(0, 0.05, 0),
                                        Eigen::Vector3d(0, 0, 0.05)}) {
    body.points.push_back(Eigen::Vector3d(0.2, 0.1, -0.3) + offset);
  }
  body.triangles.push_back({first, first + 1, first + 2});
  body.triangles.push_back({first, first + 2, first + 3});
  const BuiltGraph built = Build(body, BodyOptions(0.3));
  const StatusOr<Skinning> again = BindCloudToGraph(body, built.graph, built.binding);
  ASSERT_TRUE(again.ok());
  for (std::size_t p = 0; p < body.size(); ++p) {
    ASSERT_EQ((*again)[p].size, built.skinning[p].size) << p;
    for (int i = 0; i < built.skinning[p].size; ++i) {
      EXPECT_EQ((*again)[p].nodes[i], built.skinning[p].nodes[i]);
      EXPECT_EQ((*again)[p].weights[i], built.skinning[p].weights[i]);
    }
  }
  const auto follows_inner = [&](std::size_t p) {
    const Binding binding = built.skinning[p];
    return std::any_of(binding.nodes, binding.nodes + binding.size, [&](int node) {
      return node >= built.graph.num_surface_nodes();
    });
  };
  EXPECT_TRUE(follows_inner(first));
  EXPECT_FALSE(follows_inner(0));
}

TEST(BindCloudToGraph, AMeshInsideABodyFollowsItsInnerNodes) {
  const BuiltGraph built = Build(MakeSphereMesh(3), BodyOptions(0.3));
  PointCloud tumour = MakeSphereMesh(2);
  for (Eigen::Vector3d& point : tumour.points) point = 0.3 * point + Eigen::Vector3d(0.2, 0, 0);
  const StatusOr<Skinning> skinning = BindCloudToGraph(tumour, built.graph, built.binding);
  ASSERT_TRUE(skinning.ok());
  for (std::size_t p = 0; p < tumour.size(); ++p) {
    EXPECT_GE((*skinning)[p].nodes[0], built.graph.num_surface_nodes()) << p;
  }
}

}  // namespace
}  // namespace ceres_ed
