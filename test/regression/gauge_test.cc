// What camera and nodes can trade when every node is seen, and what settles it.
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/residual_collection.h>

#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

TestProblemOptions AllSeen() {
  TestProblemOptions options;
  options.columns = 4;
  options.points_per_cell = 4;
  options.has_camera = true;
  return options;
}

CameraPose ExamplePose(double angle) {
  CameraPose pose;
  pose.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, -1.0, 2.0).normalized());
  pose.translation = {0.4, -0.2, 0.6};
  return pose;
}

// Singular values of the Jacobian of the full problem, in the tangent space of the camera.
Eigen::VectorXd SingularValues(const ProblemBuilder& builder, DeformationState* state) {
  const BuiltProblem built = builder.Build(FullConfig(state->num_nodes(), true), state);
  ceres::CRSMatrix sparse;
  EXPECT_TRUE(built.problem->Evaluate({}, nullptr, nullptr, nullptr, &sparse));
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    for (int i = sparse.rows[row]; i < sparse.rows[row + 1]; ++i) {
      dense(row, sparse.cols[i]) = sparse.values[i];
    }
  }
  return Eigen::BDCSVD<Eigen::MatrixXd>(dense).singularValues();
}

int NumNullDirections(const Eigen::VectorXd& singular_values) {
  return static_cast<int>((singular_values.array() < 1e-10 * singular_values[0]).count());
}

void AddPosePrior(const CameraPose& prior, double sigma, StripBuilder* strip) {
  strip->problem.camera_prior = prior;
  strip->Add(
      "pose_prior", 1.0, {}, {{"rotation_sigma", 50.0 * sigma}, {"translation_sigma", sigma}});
}

TEST(Gauge, HasSixNullDirectionsWhereEveryNodeIsSeen) {
  const StripBuilder strip(AllSeen());
  for (const double angle : {0.0, 0.7}) {
    // A rigid state: E_rot and E_reg vanish, so that they see no rigid motion to second order.
    DeformationState state = RigidState(strip.problem.graph, ExamplePose(angle));
    state.camera_from_map = ExamplePose(-0.4);
    const Eigen::VectorXd values = SingularValues(strip.builder, &state);
    ASSERT_EQ(values.size(), 12 * kNodeSize + 6);
    EXPECT_EQ(NumNullDirections(values), 6);
    // The next one stands well apart.
    EXPECT_GT(values[values.size() - 7], 1e-4 * values[0]);
  }
}

TEST(Gauge, IsSettledByAPosePrior) {
  StripBuilder strip(AllSeen());
  AddPosePrior(ExamplePose(0.0), 0.02, &strip);
  DeformationState state(strip.problem.graph.num_nodes());
  EXPECT_EQ(NumNullDirections(SingularValues(strip.builder, &state)), 0);
}

TEST(Gauge, IsSettledByHoldingANode) {
  const StripBuilder strip(AllSeen());
  DeformationState state(strip.problem.graph.num_nodes());
  ProblemConfig config = FullConfig(state.num_nodes(), true);
  config.variable_nodes[0] = 0;
  const BuiltProblem built = strip.builder.Build(config, &state);
  ceres::CRSMatrix sparse;
  ceres::Problem::EvaluateOptions options;
  for (int j = 1; j < state.num_nodes(); ++j) options.parameter_blocks.push_back(state.node(j));
  options.parameter_blocks.push_back(state.camera_from_map.rotation.coeffs().data());
  options.parameter_blocks.push_back(state.camera_from_map.translation.data());
  ASSERT_TRUE(built.problem->Evaluate(options, nullptr, nullptr, nullptr, &sparse));
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.num_rows, sparse.num_cols);
  for (int row = 0; row < sparse.num_rows; ++row) {
    for (int i = sparse.rows[row]; i < sparse.rows[row + 1]; ++i) {
      dense(row, sparse.cols[i]) = sparse.values[i];
    }
  }
  EXPECT_EQ(NumNullDirections(Eigen::BDCSVD<Eigen::MatrixXd>(dense).singularValues()), 0);
}

struct Outcome {
  double energy;
  CameraPose camera;
};

// The camera starts `angle` away from the pose that took the points to their targets.
Outcome SolveFrom(double angle, const StripBuilder& strip) {
  SolverOptions options;
  options.max_iterations = 300;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  DeformationState state(strip.problem.graph.num_nodes());
  state.camera_from_map = ExamplePose(angle);
  const SolveSummary summary = MakeStrategy({})->Solve(strip.builder, options, &state);
  EXPECT_TRUE(summary.IsUsable()) << summary.message;
  return {summary.final_energy, state.camera_from_map};
}

void MoveTargets(const CameraPose& pose, StripBuilder* strip) {
  strip->problem.MoveTargets(pose);
  strip->builder.CollectResiduals(
      strip->data, **strip->registry.Create("point_to_point", {}), strip->problem.Context());
}

TEST(Gauge, LetsTheCameraEndAnywhereAtTheSameEnergy) {
  StripBuilder strip(AllSeen());
  MoveTargets(ExamplePose(0.0), &strip);
  const Outcome near = SolveFrom(0.05, strip);
  const Outcome far = SolveFrom(0.6, strip);
  EXPECT_LT(near.energy, 1e-12);
  EXPECT_LT(far.energy, 1e-12);
  EXPECT_GT(near.camera.rotation.angularDistance(far.camera.rotation), 0.1);
}

TEST(Gauge, APosePriorBringsTheCameraToItsPose) {
  StripBuilder strip(AllSeen());
  MoveTargets(ExamplePose(0.0), &strip);
  AddPosePrior(ExamplePose(0.0), 0.02, &strip);
  for (const double angle : {0.05, 0.6}) {
    const Outcome outcome = SolveFrom(angle, strip);
    EXPECT_LT(outcome.energy, 1e-12);
    EXPECT_LT(outcome.camera.rotation.angularDistance(ExamplePose(0.0).rotation), 1e-6);
    EXPECT_LT((outcome.camera.translation - ExamplePose(0.0).translation).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace ceres_ed
