#include <ceres_ed/geometry/bounding_box.h>
#include <ceres_ed/graph/edges.h>
#include <ceres_ed/graph/graph_builder.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>

namespace ceres_ed {
namespace {

using ::testing::HasSubstr;

PointCloud BumpySphere(int levels) {
  PointCloud mesh = MakeSphereMesh(levels);
  Jitter(0.1 / (1 << levels), 71, &mesh);
  return mesh;
}

BuiltGraph Build(const PointCloud& cloud, const GraphOptions& options) {
  StatusOr<BuiltGraph> built = BuildGraph(cloud, options);
  CHECK(built.ok()) << built.status().message();
  return *std::move(built);
}

void ExpectSame(const BuiltGraph& a, const BuiltGraph& b, double tolerance) {
  EXPECT_EQ(a.node_points, b.node_points);
  ASSERT_EQ(a.graph.num_edges(), b.graph.num_edges());
  for (int e = 0; e < a.graph.num_edges(); ++e) {
    EXPECT_EQ(a.graph.edges()[e].from, b.graph.edges()[e].from);
    EXPECT_EQ(a.graph.edges()[e].to, b.graph.edges()[e].to);
    EXPECT_NEAR(a.graph.edges()[e].weight, b.graph.edges()[e].weight, tolerance);
  }
  ASSERT_EQ(a.skinning.size(), b.skinning.size());
  for (std::size_t p = 0; p < a.skinning.size(); ++p) {
    ASSERT_EQ(a.skinning[p].size, b.skinning[p].size);
    for (int i = 0; i < a.skinning[p].size; ++i) {
      EXPECT_EQ(a.skinning[p].nodes[i], b.skinning[p].nodes[i]);
      EXPECT_NEAR(a.skinning[p].weights[i], b.skinning[p].weights[i], tolerance);
    }
  }
}

std::vector<GraphOptions> AllRules() {
  std::vector<GraphOptions> all;
  for (const SamplingRule sampling : {SamplingRule::kUniform, SamplingRule::kFarthest}) {
    for (const DistanceRule distance : {DistanceRule::kSurface, DistanceRule::kEuclidean}) {
      for (const EdgeRule edges : {EdgeRule::kSharedInfluence, EdgeRule::kNearest}) {
        GraphOptions options;
        options.sampling = sampling;
        options.distance = distance;
        options.edges = edges;
        options.node_spacing = 0.35;
        all.push_back(options);
      }
    }
  }
  return all;
}

TEST(BuildGraph, IsTheSameToTheBitOnASecondRunAndOnMoreThreads) {
  const PointCloud mesh = BumpySphere(3);
  for (GraphOptions options : AllRules()) {
    const BuiltGraph first = Build(mesh, options);
    options.num_threads = 3;
    ExpectSame(first, Build(mesh, options), 0.0);
  }
}

TEST(BuildGraph, DoesNotDependOnTheUnit) {
  const PointCloud mesh = BumpySphere(3);
  PointCloud scaled = mesh;
  for (Eigen::Vector3d& point : scaled.points) point *= 1000.0;
  for (GraphOptions options : AllRules()) {
    const BuiltGraph built = Build(mesh, options);
    options.node_spacing *= 1000.0;
    ExpectSame(built, Build(scaled, options), 1e-12);
    options.node_spacing = 0.0;
    ExpectSame(Build(mesh, options), Build(scaled, options), 1e-12);
  }
}

TEST(BuildGraph, BindsEveryPointAndJoinsEveryNode) {
  const PointCloud mesh = BumpySphere(3);
  for (const GraphOptions& options : AllRules()) {
    const BuiltGraph built = Build(mesh, options);
    EXPECT_EQ(built.skinning.size(), mesh.size());
    EXPECT_EQ(built.num_pieces, 1);
    EXPECT_TRUE(built.warnings.empty());
    for (int j = 0; j < built.graph.num_nodes(); ++j) {
      EXPECT_EQ(built.graph.position(j), mesh.points[built.node_points[j]]);
      // At least three partners, in both directions.
      EXPECT_GE(built.graph.incident_edges(j).size(), 6u);
    }
  }
}

TEST(BuildGraph, ReachesTheNumberOfNodesWanted) {
  const PointCloud mesh = BumpySphere(4);
  GraphOptions options;
  for (const int target : {20, 100, 450}) {
    options.target_nodes = target;
    options.sampling = SamplingRule::kUniform;
    EXPECT_NEAR(Build(mesh, options).graph.num_nodes(), target, 0.06 * target);
    options.sampling = SamplingRule::kFarthest;
    EXPECT_EQ(Build(mesh, options).graph.num_nodes(), target);
  }
}

TEST(BuildGraph, TakesItsSpacingFromTheDiagonalButNotBelowTheMesh) {
  GraphOptions options;
  const PointCloud fine = BumpySphere(5);
  EXPECT_DOUBLE_EQ(Build(fine, options).node_spacing, options.auto_spacing * Diagonal(fine.points));
  const PointCloud coarse = BumpySphere(2);
  EXPECT_DOUBLE_EQ(Build(coarse, options).node_spacing,
                   2.0 * MeanEdgeLength(BuildTopology(coarse)));
}

TEST(BuildGraph, BareCloudsAreBoundInSpace) {
  PointCloud cloud = BumpySphere(3);
  cloud.triangles.clear();
  const BuiltGraph built = Build(cloud, GraphOptions());
  EXPECT_EQ(built.binding.distance, DistanceRule::kEuclidean);
  EXPECT_EQ(built.num_pieces, 1);
  EXPECT_TRUE(built.warnings.empty());
}

TEST(BuildGraph, JoinsPiecesAndSaysSo) {
  const PointCloud sheet = MakeGridMesh(21, 21, 0.1);
  const PointCloud mesh = Append(sheet, sheet, {0, 0, 0.05});
  GraphOptions options;
  options.node_spacing = 0.4;
  const BuiltGraph joined = Build(mesh, options);
  EXPECT_EQ(joined.num_pieces, 2);
  ASSERT_EQ(joined.warnings.size(), 1u);
  EXPECT_THAT(joined.warnings[0], HasSubstr("2 pieces"));
  const std::vector<int> pieces = ConnectedPieces(joined.graph);
  EXPECT_EQ(*std::max_element(pieces.begin(), pieces.end()), 0);
  options.join_pieces = false;
  const BuiltGraph apart = Build(mesh, options);
  EXPECT_EQ(joined.graph.num_edges(), apart.graph.num_edges() + 6);
}

TEST(BuildGraph, SmallIslandsFollowTheNodesNearby) {
  PointCloud mesh = Append(MakeGridMesh(21, 21, 0.1), MakeGridMesh(2, 2, 0.1), {2.0, 2.0, 0.1});
  mesh.points.emplace_back(0, 0, 0.3);
  GraphOptions options;
  options.node_spacing = 0.4;
  const BuiltGraph built = Build(mesh, options);
  EXPECT_EQ(built.num_pieces, 1);
  for (const int p : built.node_points) EXPECT_LT(p, 441);
  for (std::size_t p = 441; p < mesh.size(); ++p) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& g : built.graph.positions()) {
      nearest = std::min(nearest, (g - mesh.points[p]).norm());
    }
    const Eigen::Vector3d& first = built.graph.position(built.skinning[p].nodes[0]);
    EXPECT_EQ((first - mesh.points[p]).norm(), nearest);
  }
}

TEST(BuildGraph, AMeshOfCrumbsIsBoundInSpace) {
  std::vector<int> source;
  PointCloud crumbs = Unweld(MakeSphereMesh(2), &source);
  // No two corners coincide any more.
  Jitter(1e-6, 72, &crumbs);
  const BuiltGraph built = Build(crumbs, GraphOptions());
  EXPECT_EQ(built.binding.distance, DistanceRule::kEuclidean);
  ASSERT_FALSE(built.warnings.empty());
  EXPECT_THAT(built.warnings[0], HasSubstr("only 0 of 960 points"));
  EXPECT_GT(built.graph.num_nodes(), 20);
}

TEST(BuildGraph, WarnsOfTooFewNodes) {
  GraphOptions options;
  options.node_spacing = 100.0;
  const BuiltGraph built = Build(BumpySphere(2), options);
  EXPECT_EQ(built.graph.num_nodes(), 1);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_THAT(built.warnings[0], HasSubstr("only 1 node for 4 neighbours"));
  const PointCloud two = Append(MakeGridMesh(9, 9), MakeGridMesh(9, 9), {0, 0, 20});
  options.node_spacing = 0.0;
  options.target_nodes = 1;
  options.sampling = SamplingRule::kFarthest;
  EXPECT_THAT(Build(two, options).warnings.back(), HasSubstr("too few for the 2 connected parts"));
}

TEST(BuildGraph, RefusesWhatCannotCarryAGraph) {
  const auto message = [](const PointCloud& cloud, const GraphOptions& options) {
    return BuildGraph(cloud, options).status().message();
  };
  const GraphOptions defaults;
  EXPECT_THAT(message(PointCloud(), defaults), HasSubstr("without points"));
  PointCloud one_place;
  one_place.points.assign(5, Eigen::Vector3d::Ones());
  EXPECT_THAT(message(one_place, defaults), HasSubstr("5 points are all at one place"));
  PointCloud bad = MakeGridMesh(3, 3);
  bad.points[7].y() = std::nan("");
  EXPECT_THAT(message(bad, defaults), HasSubstr("point 7 is not finite"));
  GraphOptions options;
  options.target_nodes = 10;
  EXPECT_THAT(message(MakeGridMesh(3, 3), options), HasSubstr("only 9 different points"));
}

TEST(GraphOptions, SayWhichValueIsOutOfRange) {
  const auto error = [](auto member, auto value) {
    GraphOptions options;
    options.*member = value;
    std::string text;
    EXPECT_FALSE(options.IsValid(&text));
    return text;
  };
  EXPECT_THAT(error(&GraphOptions::node_spacing, -1.0), HasSubstr("node_spacing is -1"));
  EXPECT_THAT(error(&GraphOptions::node_spacing, std::nan("")), HasSubstr("node_spacing is nan"));
  EXPECT_THAT(error(&GraphOptions::target_nodes, -1), HasSubstr("target_nodes is -1"));
  EXPECT_THAT(error(&GraphOptions::auto_spacing, 0.0), HasSubstr("auto_spacing is 0"));
  EXPECT_THAT(error(&GraphOptions::neighbors, 9), HasSubstr("neighbors is 9"));
  EXPECT_THAT(error(&GraphOptions::edges_per_node, 0), HasSubstr("edges_per_node is 0"));
  EXPECT_THAT(error(&GraphOptions::min_component_points, 0), HasSubstr("min_component_points"));
  EXPECT_THAT(error(&GraphOptions::edges_per_joint, 0), HasSubstr("edges_per_joint is 0"));
  EXPECT_THAT(error(&GraphOptions::num_threads, 0), HasSubstr("threads is 0"));
  std::string text;
  EXPECT_TRUE(GraphOptions().IsValid(&text)) << text;
}

}  // namespace
}  // namespace ceres_ed
