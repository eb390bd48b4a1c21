#include "ceres_ed/energy/energy_registry.h"

#include <ceres_ed/testing/cost_evaluation.h>
#include <ceres_ed/testing/energy_laws.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <test/graph/matrix_form.h>

namespace ceres_ed {
namespace {

using ::testing::IsEmpty;

std::unique_ptr<EnergyTerm> Create(const std::string& name,
                                   const std::map<std::string, double>& parameters = {}) {
  return *BuiltinEnergies().Create(name, parameters);
}

CameraPose ExampleMotion() {
  CameraPose motion;
  motion.rotation = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1.0, -1.0, 2.0).normalized());
  motion.translation = {0.3, -2.0, 1.0};
  return motion;
}

// Applies x -> motion * x after the motion of the nodes.
void MoveMap(const CameraPose& motion, const DeformationGraph& graph, DeformationState* state) {
  for (int j = 0; j < graph.num_nodes(); ++j) {
    auto A = MutableNodeAffine(state->node(j));
    auto t = MutableNodeTranslation(state->node(j));
    A = (motion.rotation.toRotationMatrix() * A).eval();
    t = (motion * (graph.position(j) + t) - graph.position(j)).eval();
  }
}

EnergyInvariance RigidMotionOfAllNodes() {
  return {"a rigid motion of all nodes",
          [](const DeformationGraph& graph, DeformationState* state) {
            MoveMap(ExampleMotion(), graph, state);
          }};
}

// The gauge freedom of Eq. 1: the nodes move rigidly, and the camera undoes it.
EnergyInvariance TradeOfNodesAndCamera() {
  return {
      "a trade of a motion between nodes and camera",
      [](const DeformationGraph& graph, DeformationState* state) {
        if (state->camera_from_map.rotation.coeffs() == Eigen::Quaterniond::Identity().coeffs() &&
            state->camera_from_map.translation.isZero()) {
          return;
        }
        const CameraPose motion = ExampleMotion();
        MoveMap(motion, graph, state);
        CameraPose& camera = state->camera_from_map;
        const Eigen::Quaterniond back = motion.rotation.conjugate();
        camera.translation -= camera.rotation * (back * motion.translation);
        camera.rotation = camera.rotation * back;
      }};
}

std::vector<std::string> Check(const std::string& name, const EnergyClaims& claims = {}) {
  return CheckEnergyLaws(BuiltinEnergies(), name, claims);
}

TEST(RotationEnergy, ObeysTheLaws) {
  EnergyClaims claims;
  claims.invariances = {RigidMotionOfAllNodes()};
  EXPECT_THAT(Check("rotation", claims), IsEmpty());
}

TEST(RegularizationEnergy, ObeysTheLaws) {
  EnergyClaims claims;
  claims.invariances = {RigidMotionOfAllNodes()};
  EXPECT_THAT(Check("regularization", claims), IsEmpty());
}

// The A_j may be anything.
EnergyInvariance ChangeOfAllAffineParts() {
  return {"a change of every A_j", [](const DeformationGraph& graph, DeformationState* state) {
            for (int j = 0; j < graph.num_nodes(); ++j) MutableNodeAffine(state->node(j)) *= -3.0;
          }};
}

TEST(NodePriorEnergy, ObeysTheLaws) {
  EnergyClaims claims;
  claims.invariances = {ChangeOfAllAffineParts()};
  EXPECT_THAT(Check("node_prior", claims), IsEmpty());
}

TEST(PosePriorEnergy, ObeysTheLaws) {
  EnergyClaims claims;
  claims.parameters = {{"rotation_sigma", 30.0}, {"translation_sigma", 0.5}};
  EXPECT_THAT(Check("pose_prior", claims), IsEmpty());
}

TEST(PointEnergies, ObeyTheLaws) {
  for (const std::string name : {"point_to_point", "point_to_plane", "landmark"}) {
    EnergyClaims claims;
    claims.invariances = {TradeOfNodesAndCamera()};
    EXPECT_THAT(Check(name, claims), IsEmpty());
  }
}

TEST(RotationEnergy, HasOneResidualBlockANode) {
  const TestProblem problem = MakeTestProblem({});
  const auto residuals = CollectResiduals(*Create("rotation"), problem.Context());
  ASSERT_EQ(residuals.size(), 18u);
  for (int j = 0; j < 18; ++j) EXPECT_EQ(residuals[j].blocks[0].node, j);
}

TEST(RegularizationEnergy, HasOneResidualBlockAnEdgeWithItsWeight) {
  TestProblem problem = MakeTestProblem({});
  DeformationGraph graph;
  for (const Eigen::Vector3d& g : problem.graph.positions()) graph.AddNode(g);
  graph.AddEdge({3, 0, 2.25});
  problem.graph = graph;
  const auto residuals = CollectResiduals(*Create("regularization"), problem.Context());
  ASSERT_EQ(residuals.size(), 1u);
  EXPECT_EQ(residuals[0].blocks[0].node, 3);
  EXPECT_EQ(residuals[0].blocks[1].node, 0);
  DeformationState state(graph.num_nodes());
  MutableNodeTranslation(state.node(3)) = Eigen::Vector3d(1.0, 2.0, 3.0);
  // sqrt(2.25) (t_3 - t_0)
  EXPECT_LT((EvaluateResiduals(*residuals[0].cost, BlocksAt(residuals[0], state)).residuals -
             Eigen::Vector3d(1.5, 3.0, 4.5))
                .norm(),
            1e-14);
}

TEST(NodePriorEnergy, PullsEachNodeTowardItsOwnPlace) {
  TestProblem problem = MakeTestProblem({});
  for (int j = 0; j < 18; ++j) problem.node_prior[j] = {0.1 * j, -1.0, 2.0};
  const auto residuals = CollectResiduals(*Create("node_prior"), problem.Context());
  ASSERT_EQ(residuals.size(), 18u);
  const DeformationState state = RandomState(problem, 0.4, 5);
  for (int j = 0; j < 18; ++j) {
    ASSERT_EQ(residuals[j].blocks.size(), 1u);
    EXPECT_EQ(residuals[j].blocks[0].node, j);
    EXPECT_EQ(residuals[j].weight, 1.0);
    const Eigen::Vector3d expected =
        NodeTranslation(state.node(j)) - Eigen::Vector3d(0.1 * j, -1.0, 2.0);
    EXPECT_EQ(EvaluateResiduals(*residuals[j].cost, BlocksAt(residuals[j], state)).residuals,
              expected);
  }
}

TEST(NodePriorEnergy, IsSilentWhereNothingIsKnown) {
  const TestProblem problem = MakeTestProblem({});
  EnergyContext context = problem.Context();
  context.node_prior = nullptr;
  EXPECT_TRUE(CollectResiduals(*Create("node_prior"), context).empty());
}

TEST(PosePriorEnergy, DividesByTheSpreads) {
  TestProblemOptions options;
  options.has_camera = true;
  TestProblem problem = MakeTestProblem(options);
  problem.camera_prior.translation = {1.0, 2.0, 3.0};
  const auto residuals =
      CollectResiduals(*Create("pose_prior", {{"rotation_sigma", 2.0}, {"translation_sigma", 0.5}}),
                       problem.Context());
  ASSERT_EQ(residuals.size(), 1u);
  DeformationState state(problem.graph.num_nodes());
  state.camera_from_map.rotation = Eigen::AngleAxisd(1e-4, Eigen::Vector3d::UnitY());
  state.camera_from_map.translation = {2.0, 2.0, 3.0};
  const Eigen::VectorXd r =
      EvaluateResiduals(*residuals[0].cost, BlocksAt(residuals[0], state)).residuals;
  EXPECT_NEAR(r[1], 2.0 * std::sin(0.5e-4) / (2.0 * M_PI / 180.0), 1e-15);
  EXPECT_NEAR(r[3], 2.0, 1e-14);
  EXPECT_NEAR(r.squaredNorm(), r[1] * r[1] + r[3] * r[3], 1e-14);
}

TEST(PosePriorEnergy, IsSilentWithoutACamera) {
  const TestProblem problem = MakeTestProblem({});
  EXPECT_TRUE(CollectResiduals(*Create("pose_prior"), problem.Context()).empty());
}

// The per-vertex form and the matrix form (Eq. 8-13) agree, also through WarpedPointCost.
TEST(PointToPointEnergy, EqualsTheMatrixFormOfThePaper) {
  for (const bool has_camera : {false, true}) {
    TestProblemOptions options;
    options.has_camera = has_camera;
    options.points_per_cell = 3;
    options.target_deviation = 0.2;
    const TestProblem problem = MakeTestProblem(options);
    const DeformationState state = RandomState(problem, 0.4, 5);
    const Eigen::MatrixXd warped =
        WarpByMatrices(problem.graph, state, problem.skinning, problem.points);
    const auto residuals = CollectResiduals(*Create("point_to_point"), problem.Context());
    ASSERT_EQ(residuals.size(), problem.correspondences.size());
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const Correspondence& c = problem.correspondences[i];
      const Eigen::Vector3d expected = warped.col(c.point) - c.target;
      EXPECT_LT((EvaluateResiduals(*residuals[i].cost, BlocksAt(residuals[i], state)).residuals -
                 expected)
                    .norm(),
                1e-13);
    }
  }
}

TEST(PointToPlaneEnergy, IsTheMatrixFormAlongTheNormal) {
  TestProblemOptions options;
  options.has_camera = true;
  options.target_deviation = 0.2;
  const TestProblem problem = MakeTestProblem(options);
  const DeformationState state = RandomState(problem, 0.4, 5);
  const Eigen::MatrixXd warped =
      WarpByMatrices(problem.graph, state, problem.skinning, problem.points);
  const auto residuals = CollectResiduals(*Create("point_to_plane"), problem.Context());
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const Correspondence& c = problem.correspondences[i];
    EXPECT_NEAR(EvaluateResiduals(*residuals[i].cost, BlocksAt(residuals[i], state)).residuals[0],
                c.normal.dot(warped.col(c.point) - c.target),
                1e-13);
  }
}

TEST(PointEnergies, PassOnTheWeightsOfTheirOwnList) {
  TestProblem problem = MakeTestProblem({});
  problem.correspondences.resize(2);
  problem.correspondences[0].weight = 0.25;
  problem.correspondences[1].weight = 0.0;
  problem.landmarks.resize(1);
  problem.landmarks[0].weight = 7.0;
  const auto points = CollectResiduals(*Create("point_to_plane"), problem.Context());
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].weight, 0.25);
  EXPECT_EQ(points[1].weight, 0.0);
  const auto landmarks = CollectResiduals(*Create("landmark"), problem.Context());
  ASSERT_EQ(landmarks.size(), 1u);
  EXPECT_EQ(landmarks[0].weight, 7.0);
}

}  // namespace
}  // namespace ceres_ed
