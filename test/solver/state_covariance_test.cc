// Compares covariances with those of Ceres, and tests cases in which there are none.
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/solver/covariance/state_covariance.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <ceres/covariance.h>
#include <ceres/manifold.h>
#include <gtest/gtest.h>
#include <test/problem/strip_builder.h>
#include <test/solver/assembly.h>

namespace ceres_ed {
namespace {

constexpr double kTolerance = 1e-6;

// Returns the covariance of all nodes in order, and of the camera if there is one, computed by
// Ceres.
Eigen::MatrixXd CovarianceByCeres(const ProblemBuilder& builder, DeformationState state) {
  const ProblemConfig config = FullConfig(state.num_nodes(), builder.has_camera());
  const BuiltProblem built = builder.Build(config, &state);
  std::vector<const double*> blocks;
  for (int j = 0; j < state.num_nodes(); ++j) blocks.push_back(state.node(j));
  int size = state.num_nodes() * kNodeSize;
  if (builder.has_camera()) {
    blocks.push_back(state.camera_from_map.rotation.coeffs().data());
    blocks.push_back(state.camera_from_map.translation.data());
    size += 6;
  }
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  ceres::Covariance covariance(options);
  EXPECT_TRUE(covariance.Compute(blocks, built.problem.get()));
  // The matrix is symmetric, so row-major equals column-major.
  Eigen::MatrixXd Z(size, size);
  EXPECT_TRUE(covariance.GetCovarianceMatrixInTangentSpace(blocks, Z.data()));
  return Z;
}

StateCovariance CovarianceOf(const ProblemBuilder& builder,
                             const DeformationState& state,
                             const CovarianceOptions& options = {}) {
  StatusOr<StateCovariance> covariance = StateCovariance::Compute(
      builder, FullConfig(state.num_nodes(), builder.has_camera()), state, options);
  CHECK(covariance.ok()) << covariance.status().message();
  return *std::move(covariance);
}

void ExpectNear(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected) {
  ASSERT_EQ(actual.rows(), expected.rows());
  // The difference is relative to the standard deviations of each entry's row and column, whatever
  // their units.
  const Eigen::VectorXd root = expected.diagonal().cwiseSqrt();
  for (int r = 0; r < actual.rows(); ++r) {
    for (int c = 0; c < actual.cols(); ++c) {
      EXPECT_NEAR(actual(r, c), expected(r, c), kTolerance * root[r] * root[c]) << r << " " << c;
    }
  }
}

// Returns d point / d (all nodes, camera) by central differences; in the camera frame if
// `in_camera`.
Eigen::MatrixXd PointDerivative(const TestProblem& problem,
                                const DeformationState& state,
                                const Eigen::Vector3d& position,
                                const Binding& binding,
                                bool in_camera) {
  const auto point = [&](int parameter, double step) -> Eigen::Vector3d {
    DeformationState moved = state;
    const int camera = parameter - state.num_nodes() * kNodeSize;
    CameraPose& pose = moved.camera_from_map;
    if (camera < 0) {
      moved.node(parameter / kNodeSize)[parameter % kNodeSize] += step;
    } else if (camera < 3) {
      const Eigen::Vector3d delta = step * Eigen::Vector3d::Unit(camera);
      ceres::EigenQuaternionManifold().Plus(state.camera_from_map.rotation.coeffs().data(),
                                            delta.data(),
                                            pose.rotation.coeffs().data());
    } else {
      pose.translation[camera - 3] += step;
    }
    const Eigen::Vector3d warped = WarpPoint(problem.graph, moved, binding, position);
    return in_camera ? pose * warped : warped;
  };
  const int size = state.num_nodes() * kNodeSize + (problem.has_camera ? 6 : 0);
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd J(3, size);
  for (int i = 0; i < size; ++i) J.col(i) = (point(i, kStep) - point(i, -kStep)) / (2.0 * kStep);
  return J;
}

class AgainstCeres : public testing::TestWithParam<std::pair<bool, LossSpec>> {};

TEST_P(AgainstCeres, HasTheCovarianceOfNodesCameraAndPoints) {
  const auto& [has_camera, loss] = GetParam();
  const TestProblem problem = MakeProblem(has_camera);
  const std::unique_ptr<ProblemBuilder> builder = MakeBuilder(problem, loss);
  const DeformationState state = RandomState(problem, 0.05, 3);
  const Eigen::MatrixXd Z = CovarianceByCeres(*builder, state);
  const StateCovariance covariance = CovarianceOf(*builder, state);

  EXPECT_TRUE(covariance.undetermined().empty());
  for (int j = 0; j < state.num_nodes(); ++j) {
    EXPECT_EQ(covariance.status(j), ParameterStatus::kDetermined);
    ExpectNear(covariance.Node(j), Z.block(j * kNodeSize, j * kNodeSize, kNodeSize, kNodeSize));
  }
  if (has_camera) {
    EXPECT_EQ(covariance.camera_status(), ParameterStatus::kDetermined);
    ExpectNear(covariance.Camera(), Z.bottomRightCorner(6, 6));
  }
  // The points are points with data, points without, and one whose nodes share no residual.
  const int far[] = {0, 13, state.num_nodes() - 1};
  const double weights[] = {0.5, 0.3, 0.2};
  const std::size_t last = problem.points.size() - 1;
  const std::vector<std::pair<Eigen::Vector3d, Binding>> points = {
      {problem.points[0], problem.skinning[0]},
      {problem.points[last], problem.skinning[last]},
      {{2.0, 1.0, 0.5}, {far, weights, 3}}};
  for (const auto& [position, binding] : points) {
    for (const bool in_camera : {false, true}) {
      const Eigen::MatrixXd J = PointDerivative(problem, state, position, binding, in_camera);
      const Eigen::Matrix3d actual = in_camera ? covariance.PointInCamera(position, binding)
                                               : covariance.Point(position, binding);
      ExpectNear(actual, J * Z * J.transpose());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         AgainstCeres,
                         testing::Values(std::pair(false, LossSpec{}),
                                         std::pair(true, LossSpec{}),
                                         std::pair(true, LossSpec{LossType::kHuber, 0.05}),
                                         std::pair(true, LossSpec{LossType::kWelsch, 0.3})));

TEST(StateCovariance, IsTheSameAtAnyNumberOfThreadsAndWithPointsKnownAhead) {
  const TestProblem problem = MakeProblem(true);
  const std::unique_ptr<ProblemBuilder> builder = MakeBuilder(problem, {});
  const DeformationState state = RandomState(problem, 0.05, 3);
  const StateCovariance one = CovarianceOf(*builder, state, {nullptr, 1});
  const StateCovariance three = CovarianceOf(*builder, state, {nullptr, 3});
  const StateCovariance ahead = CovarianceOf(*builder, state, {&problem.skinning, 1});
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const Eigen::Matrix3d point = one.Point(problem.points[p], problem.skinning[p]);
    EXPECT_EQ(point, three.Point(problem.points[p], problem.skinning[p]));
    ExpectNear(ahead.Point(problem.points[p], problem.skinning[p]), point);
  }
}

// A strip with data; beside it three nodes that only their common edges hold, and a single node.
TEST(StateCovariance, ReportsNodesThatNothingDeterminesAndGetsTheOthersRight) {
  const TestProblem strip = MakeProblem(false);
  const std::unique_ptr<ProblemBuilder> strip_builder = MakeBuilder(strip, {});
  const int n = strip.graph.num_nodes();
  const StateCovariance expected = CovarianceOf(*strip_builder, DeformationState(n));

  TestProblem more = strip;
  for (int j = 0; j < 4; ++j) more.graph.AddNode({j * 1.0, 20.0 + 0.5 * j * j, 0.1 * j});
  for (int j = 0; j < 3; ++j) {
    more.graph.AddEdge({n + j, n + (j + 1) % 3, 1.0});
    more.graph.AddEdge({n + (j + 1) % 3, n + j, 1.0});
  }
  const std::unique_ptr<ProblemBuilder> builder = MakeBuilder(more, {});
  const StateCovariance covariance = CovarianceOf(*builder, DeformationState(n + 4));
  EXPECT_EQ(covariance.undetermined(), (std::vector<int>{n, n + 1, n + 2, n + 3}));
  for (int j = 0; j < n; ++j) {
    EXPECT_EQ(covariance.status(j), ParameterStatus::kDetermined);
    ExpectNear(covariance.Node(j), expected.Node(j));
  }
  EXPECT_TRUE(covariance.Node(n).array().isNaN().all());
  const int nodes[] = {0, n + 1};
  const double weights[] = {0.9, 0.1};
  EXPECT_TRUE(covariance.Point({1.0, 1.0, 0.0}, {nodes, weights, 2}).array().isNaN().all());
  EXPECT_FALSE(covariance.Point(more.points[0], more.skinning[0]).hasNaN());
}

TEST(StateCovariance, ReportsNodesWithoutDataAndWithoutPriors) {
  TestProblemOptions options;
  options.columns = 7;
  options.points_per_cell = 40;
  options.observed_columns = 2;
  StripBuilder strip(options);
  strip.builder.SetWeight(strip.rotation, 0.0);
  strip.builder.SetWeight(strip.regularization, 0.0);
  const int n = strip.problem.graph.num_nodes();
  const StateCovariance covariance = CovarianceOf(strip.builder, DeformationState(n));
  for (int j = 0; j < n; ++j) {
    // There are three rows of nodes; the cells of the first two columns lie between columns 0, 1
    // and 2.
    if (j / options.rows > 2) {
      EXPECT_EQ(covariance.status(j), ParameterStatus::kUndetermined);
    }
  }
}

TEST(StateCovariance, ReportsAFreeGauge) {
  TestProblemOptions options;
  options.has_camera = true;
  options.target_deviation = 0.1;
  StripBuilder strip(options);
  const DeformationState state = RandomState(strip.problem, 0.05, 3);
  const int n = state.num_nodes();
  // Camera and map can move as one.
  const StateCovariance free = CovarianceOf(strip.builder, state);
  EXPECT_EQ(free.undetermined().size(), std::size_t(n));
  EXPECT_EQ(free.camera_status(), ParameterStatus::kUndetermined);
  EXPECT_TRUE(free.Camera().array().isNaN().all());
  // They cannot if one of them is held.
  ProblemConfig config = FullConfig(n, true);
  config.variable_nodes[0] = 0;
  const StatusOr<StateCovariance> held = StateCovariance::Compute(strip.builder, config, state, {});
  ASSERT_TRUE(held.ok());
  EXPECT_TRUE(held->undetermined().empty());
  EXPECT_EQ(held->status(0), ParameterStatus::kHeld);
  EXPECT_EQ(held->Node(0), Eigen::MatrixXd::Zero(kNodeSize, kNodeSize));
  EXPECT_GT(held->Camera().diagonal().minCoeff(), 0.0);
  // Without data nothing determines the shape either.
  strip.builder.SetWeight(strip.data, 0.0);
  EXPECT_EQ(CovarianceOf(strip.builder, DeformationState(n)).undetermined().size(), std::size_t(n));
}

TEST(StateCovariance, NamesAResidualThatCannotBeEvaluated) {
  StripBuilder strip({});
  DeformationState state(strip.problem.graph.num_nodes());
  state.node(4)[2] = std::nan("");
  const StatusOr<StateCovariance> covariance =
      StateCovariance::Compute(strip.builder, FullConfig(state.num_nodes(), false), state, {});
  ASSERT_FALSE(covariance.ok());
  EXPECT_NE(covariance.status().message().find("4"), std::string::npos)
      << covariance.status().message();
}

// With force = J^T J v the change is v.
TEST(StateCovariance, FindsTheChangeThatAForceCauses) {
  const TestProblem problem = MakeProblem(/*has_camera=*/false);
  const std::unique_ptr<ProblemBuilder> builder = MakeBuilder(problem, {LossType::kHuber, 1e3});
  const DeformationState state = RandomState(problem, 0.05, 3);
  const ProblemConfig config = FullConfig(state.num_nodes(), false);
  const Assembled assembled = AssembleInBlocks(*builder, config, state, 1);
  Eigen::VectorXd change(assembled.gradient.size());
  for (Eigen::Index i = 0; i < change.size(); ++i) change[i] = std::sin(1.0 + 0.7 * double(i));
  const Eigen::VectorXd force = assembled.H * change;
  EXPECT_LT((CovarianceOf(*builder, state).SolveNodes(force) - change).norm(),
            1e-5 * change.norm());
}

}  // namespace
}  // namespace ceres_ed
