#include <ceres_ed/geometry/sampling.h>
#include <ceres_ed/graph/binding.h>
#include <ceres_ed/graph/warp.h>

#include <cmath>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cost_functions/node_parameters.h>
#include <gtest/gtest.h>
#include <test/geometry/meshes.h>
#include <test/graph/matrix_form.h>

namespace ceres_ed {
namespace {

// A grid with a graph on it, in a random state near rest.
struct Scene {
  PointCloud cloud = MakeGridMesh(9, 9, 0.25);
  Warp warp;
  Skinning skinning;
};

Scene MakeScene(double amount) {
  Scene scene;
  const SurfaceTopology topology = BuildTopology(scene.cloud);
  const std::vector<int> nodes = UniformDownsampleAlongSurface(topology, 0.6);
  for (const int p : nodes) scene.warp.graph.AddNode(scene.cloud.points[p]);
  scene.skinning = BindPoints(scene.cloud, topology, nodes, scene.warp.binding);
  scene.warp.state.Resize(scene.warp.graph.num_nodes());
  const std::vector<Eigen::Vector3d> moves = RandomPoints(4 * scene.warp.graph.num_nodes(), 61);
  for (int j = 0; j < scene.warp.graph.num_nodes(); ++j) {
    for (int i = 0; i < kNodeSize; ++i) {
      scene.warp.state.node(j)[i] += amount * moves[4 * j + i / 3][i % 3];
    }
  }
  return scene;
}

Similarity Example() {
  Similarity s;
  s.scale = 2.0;
  s.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()));
  s.translation = {3, -2, 1};
  return s;
}

TEST(WarpPoint, EqualsTheMatrixFormOfThePaper) {
  Scene scene = MakeScene(0.3);
  scene.warp.state.camera_from_map = {Example().rotation, Example().translation};
  const Eigen::MatrixXd expected =
      WarpByMatrices(scene.warp.graph, scene.warp.state, scene.skinning, scene.cloud.points);
  for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
    const Eigen::Vector3d in_map =
        WarpPoint(scene.warp.graph, scene.warp.state, scene.skinning[p], scene.cloud.points[p]);
    EXPECT_LT((scene.warp.state.camera_from_map * in_map - expected.col(p)).norm(), 1e-12);
  }
}

TEST(WarpPoint, AtRestIsThePoint) {
  const Scene scene = MakeScene(0.0);
  for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
    const Eigen::Vector3d warped =
        WarpPoint(scene.warp.graph, scene.warp.state, scene.skinning[p], scene.cloud.points[p]);
    EXPECT_LT((warped - scene.cloud.points[p]).norm(), 1e-15);
  }
}

TEST(WarpPoint, ReproducesAnAffineMotionOfAllNodes) {
  Scene scene = MakeScene(0.0);
  Eigen::Matrix3d A;
  A << 1.1, 0.2, -0.3, 0.4, 0.9, 0.1, -0.2, 0.3, 1.2;
  const Eigen::Vector3d b(5, -6, 7);
  for (int j = 0; j < scene.warp.graph.num_nodes(); ++j) {
    const Eigen::Vector3d& g_j = scene.warp.graph.position(j);
    MutableNodeAffine(scene.warp.state.node(j)) = A;
    MutableNodeTranslation(scene.warp.state.node(j)) = A * g_j + b - g_j;
  }
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
  for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
    const Eigen::Vector3d& v = scene.cloud.points[p];
    EXPECT_LT(
        (WarpPoint(scene.warp.graph, scene.warp.state, scene.skinning[p], v) - (A * v + b)).norm(),
        1e-13);
    EXPECT_LT((WarpNormal(scene.warp.state, scene.skinning[p], normal) -
               (A.inverse().transpose() * normal).normalized())
                  .norm(),
              1e-14);
  }
}

TEST(WarpNormal, EqualsTheCrossProductOfWarpedTangents) {
  const Scene scene = MakeScene(0.3);
  const double h = 1e-4;
  for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
    const auto difference = [&](const Eigen::Vector3d& along) -> Eigen::Vector3d {
      const auto at = [&](double step) {
        return WarpPoint(scene.warp.graph,
                         scene.warp.state,
                         scene.skinning[p],
                         scene.cloud.points[p] + step * along);
      };
      return (at(h) - at(-h)) / (2.0 * h);
    };
    const Eigen::Vector3d expected =
        difference(Eigen::Vector3d::UnitX()).cross(difference(Eigen::Vector3d::UnitY()));
    const Eigen::Vector3d normal =
        WarpNormal(scene.warp.state, scene.skinning[p], Eigen::Vector3d::UnitZ());
    // The warp is linear when the weights are constant; the rounding error is 1e-16 / h.
    EXPECT_LT((normal - expected.normalized()).norm(), 1e-11);
  }
}

// The state of one node with the affine part G, and a binding to this node.
struct OneNode {
  explicit OneNode(const Eigen::Matrix3d& G) : state(1) { MutableNodeAffine(state.node(0)) = G; }
  Binding binding() const { return {&index, &weight, 1}; }

  DeformationState state;
  int index = 0;
  double weight = 1.0;
};

TEST(WarpNormal, LivesWithASingularGradient) {
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), x = Eigen::Vector3d::UnitX();
  const OneNode flat(Eigen::Vector3d(1, 1, 0).asDiagonal().toDenseMatrix());
  EXPECT_EQ(WarpNormal(flat.state, flat.binding(), z), z);
  // x lies in the plane that remains. The cofactor matrix takes it to zero; the nearest rotation
  // does not change it.
  EXPECT_LT((WarpNormal(flat.state, flat.binding(), x) - x).norm(), 1e-15);
  const OneNode collapsed(Eigen::Matrix3d::Zero());
  EXPECT_NEAR(WarpNormal(collapsed.state, collapsed.binding(), z).norm(), 1.0, 1e-15);
  const OneNode turned(3.0 * Example().rotation.toRotationMatrix());
  EXPECT_LT((WarpNormal(turned.state, turned.binding(), z) - Example().rotation * z).norm(), 1e-15);
}

TEST(WarpNormal, KeepsAZeroNormalAndTheWindingUnderAReflection) {
  const OneNode mirrored(Eigen::Vector3d(1, 1, -1).asDiagonal().toDenseMatrix());
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero(), z = Eigen::Vector3d::UnitZ();
  EXPECT_EQ(WarpNormal(mirrored.state, mirrored.binding(), zero), zero);
  // A triangle in the plane keeps its corners, and therefore its normal.
  EXPECT_EQ(WarpNormal(mirrored.state, mirrored.binding(), z), z);
}

TEST(WarpPoints, AreTheSameOnAnyNumberOfThreadsAndInPlace) {
  const Scene scene = MakeScene(0.3);
  std::vector<Eigen::Vector3d> one, in_place = scene.cloud.points;
  WarpPoints(scene.warp.graph, scene.warp.state, scene.skinning, scene.cloud.points, 1, &one);
  WarpPoints(scene.warp.graph, scene.warp.state, scene.skinning, in_place, 3, &in_place);
  EXPECT_EQ(one, in_place);
}

TEST(ApplyWarp, TakesPointsAndNormalsIntoTheTargetFrame) {
  Scene scene = MakeScene(0.3);
  scene.warp.target_from_source = Example();
  PointCloud cloud = scene.cloud;
  cloud.normals.assign(cloud.size(), Eigen::Vector3d::UnitZ());
  const Status status = ApplyWarp(scene.warp, &cloud);
  ASSERT_TRUE(status.ok()) << status.message();
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    const Binding binding = scene.skinning[p];
    EXPECT_EQ(
        cloud.points[p],
        Example() * WarpPoint(scene.warp.graph, scene.warp.state, binding, scene.cloud.points[p]));
    EXPECT_EQ(cloud.normals[p],
              Example().rotation * WarpNormal(scene.warp.state, binding, Eigen::Vector3d::UnitZ()));
  }
  EXPECT_EQ(cloud.triangles, scene.cloud.triangles);
}

TEST(ApplyWarp, RefusesPartsThatDoNotFit) {
  Scene scene = MakeScene(0.0);
  PointCloud cloud = scene.cloud;
  EXPECT_FALSE(ApplyWarp(Warp(), &cloud).ok());
  PointCloud other = MakeGridMesh(2, 2);
  EXPECT_FALSE(ApplyWarp(scene.warp, scene.skinning, &other).ok());
  scene.warp.state.Resize(scene.warp.graph.num_nodes() + 1);
  EXPECT_FALSE(ApplyWarp(scene.warp, &cloud).ok());
}

}  // namespace
}  // namespace ceres_ed
