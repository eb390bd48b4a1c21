#include <ceres_ed/graph/space_warp.h>

#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>
#include <test/graph/warp_examples.h>

namespace ceres_ed {
namespace {

// A warp with a placement and a finish of 60 points.
Warp MakeFinishedWarp() {
  Warp warp = MakeLatticeWarp(4, 0.4, 0.2);
  warp.target_from_source.scale = 1.7;
  warp.target_from_source.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()));
  warp.target_from_source.translation = {5, -3, 2};
  for (const Eigen::Vector3d& p : RandomPoints(60, 9)) {
    warp.finish.points.emplace_back(1.5 * p + Eigen::Vector3d::Constant(1.5));
    warp.finish.displacements.emplace_back(0.05 * p.y(), 0.05 * p.x() * p.z(), 0.02);
  }
  return warp;
}

// The same with nodes inside a body, which all others reach by few edges.
Warp MakeWarpOfBody() {
  const Warp warp = MakeFinishedWarp();
  Warp body = warp;
  body.graph = DeformationGraph();
  const int num_nodes = warp.graph.num_nodes();
  for (int j = 0; j < num_nodes - 20; ++j) body.graph.AddNode(warp.graph.position(j));
  for (int j = num_nodes - 20; j < num_nodes; ++j) {
    body.graph.AddInnerNode(warp.graph.position(j));
  }
  for (int j = 1; j < num_nodes; ++j) {
    body.graph.AddEdge({j, j - 1, 1.0});
    body.graph.AddEdge({j - 1, j, 1.0});
    if (j >= 4) body.graph.AddEdge({j, j - 4, 1.0});
  }
  return body;
}

std::unique_ptr<const SpaceWarp> Create(const Warp& warp) {
  StatusOr<std::unique_ptr<const SpaceWarp>> created = SpaceWarp::Create(warp);
  EXPECT_TRUE(created.ok()) << created.status().message();
  return *std::move(created);
}

// Points in and around the lattice of nodes.
std::vector<Eigen::Vector3d> Queries(int count) {
  std::vector<Eigen::Vector3d> queries = RandomPoints(count, 77);
  for (Eigen::Vector3d& p : queries) p = 2.5 * p + Eigen::Vector3d::Constant(1.5);
  return queries;
}

TEST(SpaceWarp, MovesPointsAsThoseOfACloudToTheSameBits) {
  for (const Warp& warp : {MakeFinishedWarp(), MakeWarpOfBody(), MakeLatticeWarp(1, 0.3, 1.0)}) {
    PointCloud cloud;
    cloud.points = Queries(200);
    // Node and finish points, too.
    cloud.points.push_back(warp.graph.position(0));
    if (!warp.finish.empty()) cloud.points.push_back(warp.finish.points[7]);
    const std::vector<Eigen::Vector3d> rest = cloud.points;
    ASSERT_TRUE(ApplyWarp(warp, &cloud).ok());
    const std::unique_ptr<const SpaceWarp> space = Create(warp);
    Eigen::Matrix3d gradient;
    for (std::size_t p = 0; p < rest.size(); ++p) {
      EXPECT_EQ((*space)(rest[p]), cloud.points[p]) << p;
      EXPECT_EQ(space->Evaluate(rest[p], &gradient), cloud.points[p]) << p;
    }
  }
}

// Returns the largest error of the gradients against differences, at points where the differences
// of two lengths agree: the others lie beside a kink.
double LargestGradientError(const Warp& warp, int* num_smooth) {
  const std::unique_ptr<const SpaceWarp> space = Create(warp);
  const auto differences = [&](const Eigen::Vector3d& x, double h) {
    Eigen::Matrix3d G;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(c);
      G.col(c) = ((*space)(x + step) - (*space)(x - step)) / (2.0 * h);
    }
    return G;
  };
  double largest = 0.0;
  *num_smooth = 0;
  for (const Eigen::Vector3d& x : Queries(300)) {
    const Eigen::Matrix3d expected = differences(x, 1e-6);
    if ((expected - differences(x, 1e-5)).norm() > 1e-6) continue;
    ++*num_smooth;
    Eigen::Matrix3d gradient;
    space->Evaluate(x, &gradient);
    largest = std::max(largest, (gradient - expected).norm());
  }
  return largest;
}

TEST(SpaceWarp, HasTheGradientOfNumericDifferences) {
  for (const Warp& warp : {MakeFinishedWarp(), MakeWarpOfBody(), MakeLatticeWarp(1, 0.3, 1.0)}) {
    int num_smooth = 0;
    EXPECT_LT(LargestGradientError(warp, &num_smooth), 1e-6);
    EXPECT_GT(num_smooth, 250);
  }
}

TEST(SpaceWarp, SaysWhyAWarpIsNone) {
  EXPECT_THAT(SpaceWarp::Create(Warp()).status().message(), ::testing::HasSubstr("no nodes"));
  Warp warp = MakeLatticeWarp(2, 0.0, 0.0);
  warp.binding.neighbors = 9;
  EXPECT_THAT(SpaceWarp::Create(warp).status().message(), ::testing::HasSubstr("neighbors"));
}

}  // namespace
}  // namespace ceres_ed
