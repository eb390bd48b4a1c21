// Compares the marginalisation with dense linear algebra on the linearisation of Ceres.
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <ceres/crs_matrix.h>
#include <gtest/gtest.h>
#include <test/linear_algebra/dense_matrix.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

// There are points in the first column of cells only: the first two of six columns of nodes are PR.
TestProblemOptions OneColumnSeen(bool has_camera = false) {
  TestProblemOptions options = HalfSeen(has_camera, 4);
  options.observed_columns = 1;
  return options;
}

// Returns a config that eliminates the nodes of the columns [first, last).
ProblemConfig Columns(int first, int last) {
  ProblemConfig config;
  config.variable_nodes.assign(18, 0);
  for (int j = 3 * first; j < 3 * last; ++j) config.variable_nodes[j] = 1;
  return config;
}

// The linearised energy of the residuals that touch the nodes to eliminate, over these nodes and
// then the boundary: cost + g^T d + d^T H d / 2.
struct DenseModel {
  double cost = 0.0;
  Eigen::VectorXd g;
  Eigen::MatrixXd H;

  DenseModel(const ProblemBuilder& builder,
             const ProblemConfig& config,
             const Marginalization& nodes,
             double damping,
             DeformationState state) {
    const BuiltProblem built = builder.Build(config, &state);
    ceres::Problem::EvaluateOptions options;
    for (const auto* list : {&nodes.eliminated_nodes(), &nodes.boundary_nodes()}) {
      for (const int node : *list) {
        built.problem->SetParameterBlockVariable(state.node(node));
        options.parameter_blocks.push_back(state.node(node));
      }
    }
    ceres::CRSMatrix crs;
    std::vector<double> gradient;
    EXPECT_TRUE(built.problem->Evaluate(options, &cost, nullptr, &gradient, &crs));
    const Eigen::MatrixXd J = DenseOf(crs);
    g = Eigen::Map<Eigen::VectorXd>(gradient.data(), gradient.size());
    H = J.transpose() * J;
    num_eliminated = static_cast<int>(nodes.eliminated_nodes().size()) * kNodeSize;
    for (int i = 0; i < num_eliminated; ++i) H(i, i) *= 1.0 + damping;
  }

  // Returns the minimum over the eliminated unknowns for a step of the boundary.
  Eigen::VectorXd BestStep(const Eigen::VectorXd& boundary_step) const {
    const Eigen::Index n = num_eliminated;
    return -H.topLeftCorner(n, n).llt().solve(
        Eigen::VectorXd(g.head(n) + H.topRightCorner(n, boundary_step.size()) * boundary_step));
  }

  double Value(const Eigen::VectorXd& eliminated_step, const Eigen::VectorXd& boundary_step) const {
    Eigen::VectorXd d(g.size());
    d << eliminated_step, boundary_step;
    return cost + g.dot(d) + 0.5 * d.dot(H * d);
  }

  int num_eliminated = 0;
};

void MoveNodes(const std::vector<int>& nodes, const Eigen::VectorXd& step, DeformationState* to) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Eigen::Map<Eigen::VectorXd>(to->node(nodes[i]), kNodeSize) +=
        step.segment(static_cast<Eigen::Index>(i) * kNodeSize, kNodeSize);
  }
}

Eigen::VectorXd Nodes(const std::vector<int>& nodes, const DeformationState& state) {
  Eigen::VectorXd all(nodes.size() * kNodeSize);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    all.segment(static_cast<Eigen::Index>(i) * kNodeSize, kNodeSize) =
        Eigen::Map<const Eigen::VectorXd>(state.node(nodes[i]), kNodeSize);
  }
  return all;
}

void Eliminate(const ProblemBuilder& builder,
               const ProblemConfig& config,
               const DeformationState& state,
               double damping,
               Marginalization* marginalization) {
  const Status status = marginalization->SetProblem(builder, config);
  ASSERT_TRUE(status.ok()) << status.message();
  ASSERT_TRUE(marginalization->Linearize(state, 1));
  ASSERT_TRUE(marginalization->Eliminate(damping));
}

// Compares the priors of both objects, relative to their largest entries.
void ExpectSamePrior(const Marginalization& a, const Marginalization& b, double tolerance) {
  ASSERT_EQ(a.boundary_nodes(), b.boundary_nodes());
  const Quadratic& one = a.prior().quadratic();
  const Quadratic& other = b.prior().quadratic();
  EXPECT_EQ(one.origin, other.origin);
  EXPECT_LT((one.hessian - other.hessian).norm(), tolerance * other.hessian.norm());
  EXPECT_LT((one.gradient - other.gradient).norm(), tolerance * other.gradient.norm());
  EXPECT_NEAR(one.constant, other.constant, tolerance * other.constant);
}

TEST(Marginalization, PriorIsTheLeastLinearisedEnergyAndBackSubstitutionWhereItIs) {
  for (const LossType loss : {LossType::kSquared, LossType::kWelsch}) {
    StripBuilder strip(OneColumnSeen());
    strip.builder.SetLoss(strip.rotation, {loss, 0.5});
    strip.builder.SetLoss(strip.regularization, {loss, 0.5});
    const DeformationState state = RandomState(strip.problem, 0.1, 4);
    for (const double damping : {0.0, 0.01}) {
      Marginalization marginalization;
      Eliminate(strip.builder, Columns(2, 6), state, damping, &marginalization);
      ASSERT_EQ(marginalization.eliminated_nodes().size(), 12u);
      ASSERT_EQ(marginalization.boundary_nodes(), (std::vector<int>{3, 4, 5}));
      const DenseModel model(strip.builder, Columns(2, 6), marginalization, damping, state);
      EXPECT_NEAR(marginalization.energy(), model.cost, 1e-12 * model.cost);
      for (int seed = 0; seed < 3; ++seed) {
        std::srand(seed);
        const Eigen::VectorXd boundary_step = 0.1 * Eigen::VectorXd::Random(36);
        const Eigen::VectorXd step = model.BestStep(boundary_step);
        DeformationState moved = state;
        MoveNodes(marginalization.boundary_nodes(), boundary_step, &moved);
        const double expected = model.Value(step, boundary_step);
        EXPECT_NEAR(marginalization.PriorValue(moved), expected, 1e-10 * expected);
        marginalization.BackSubstitute(&moved);
        const Eigen::VectorXd found = Nodes(marginalization.eliminated_nodes(), moved) -
                                      Nodes(marginalization.eliminated_nodes(), state);
        EXPECT_LT((found - step).norm(), 1e-9 * step.norm());
      }
    }
  }
}

TEST(Marginalization, ARigidMotionOfTheBoundaryCostsNothing) {
  StripBuilder strip(OneColumnSeen());
  const DeformationState rest(18);
  Marginalization marginalization;
  Eliminate(strip.builder, Columns(2, 6), rest, 0.0, &marginalization);
  const Quadratic& prior = marginalization.prior().quadratic();
  EXPECT_NEAR(prior.constant, 0.0, 1e-15);
  EXPECT_LT(prior.gradient.norm(), 1e-14);
  for (int axis = 0; axis < 3; ++axis) {
    // A small rotation about an axis, and a translation along it.
    CameraPose turn;
    constexpr double kAngle = 1e-6;
    turn.rotation = Eigen::AngleAxisd(kAngle, Eigen::Vector3d::Unit(axis));
    turn.translation = kAngle * Eigen::Vector3d::Unit(axis);
    const Eigen::VectorXd motion =
        (Nodes(marginalization.boundary_nodes(), RigidState(strip.problem.graph, turn)) -
         prior.origin) /
        kAngle;
    EXPECT_LT((prior.hessian * motion).norm(), 1e-5 * prior.hessian.norm());
  }
  // The prior as a residual has no component in these directions either.
  const Eigen::MatrixXd& root = marginalization.prior().SquareRoot().root;
  EXPECT_LT((root.transpose() * root - prior.hessian).norm(), 1e-12 * prior.hessian.norm());
}

// A prior is a residual like any other.
TEST(Marginalization, InTwoStagesIsTheSameAsInOne) {
  StripBuilder strip(OneColumnSeen());
  const DeformationState state = RandomState(strip.problem, 0.1, 6);
  Marginalization at_once;
  Eliminate(strip.builder, Columns(2, 6), state, 0.0, &at_once);
  Marginalization first;
  Eliminate(strip.builder, Columns(4, 6), state, 0.0, &first);
  ProblemConfig rest = Columns(2, 4);
  rest.eliminated_nodes = Columns(4, 6).variable_nodes;
  rest.extra_residuals = {first.PriorResidual()};
  Marginalization second;
  Eliminate(strip.builder, rest, state, 0.0, &second);
  ExpectSamePrior(second, at_once, 1e-10);
  EXPECT_NEAR(second.energy(), at_once.energy() - first.energy() + first.PriorValue(state), 1e-12);

  DeformationState expected = state;
  std::srand(1);
  MoveNodes(at_once.boundary_nodes(), 0.1 * Eigen::VectorXd::Random(36), &expected);
  DeformationState found = expected;
  at_once.BackSubstitute(&expected);
  second.BackSubstitute(&found);
  first.BackSubstitute(&found);
  for (int j = 0; j < 18; ++j) {
    for (int i = 0; i < kNodeSize; ++i) EXPECT_NEAR(found.node(j)[i], expected.node(j)[i], 1e-10);
  }
}

// The prior energy is linear in t: if its target moves, only the gradient changes.
TEST(Marginalization, UpdateWithAMovedTargetIsTheSameAsANewElimination) {
  StripBuilder strip(OneColumnSeen());
  const int node_prior = strip.Add("node_prior", 0.5);
  DeformationState state = RandomState(strip.problem, 0.1, 7);
  Marginalization updated;
  Eliminate(strip.builder, Columns(2, 6), state, 0.0, &updated);
  for (int j = 0; j < 18; ++j) strip.problem.node_prior[j] = {0.01 * j, -0.1, 0.2};
  strip.builder.CollectResiduals(
      node_prior, **strip.registry.Create("node_prior", {}), strip.problem.Context());
  // Lambda does not depend on t, so t may change as well.
  for (int j = 6; j < 18; ++j) state.node(j)[kNodeTranslationOffset] += 0.3;
  ASSERT_TRUE(updated.SetProblem(strip.builder, Columns(2, 6)).ok());
  ASSERT_TRUE(updated.has_factor());
  EXPECT_EQ(updated.LargestChange(state), 0.0);
  ASSERT_TRUE(updated.Update(state, 1));
  EXPECT_FALSE(updated.is_fresh());
  Marginalization anew;
  Eliminate(strip.builder, Columns(2, 6), state, 0.0, &anew);
  ExpectSamePrior(updated, anew, 1e-12);
  DeformationState expected = state;
  DeformationState found = state;
  anew.BackSubstitute(&expected);
  updated.BackSubstitute(&found);
  const std::vector<double> all = AllParameters(expected);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(AllParameters(found)[i], all[i], 1e-12);
}

TEST(Marginalization, ForgetsTheFactorWithOtherWeightsOrNodes) {
  StripBuilder strip(OneColumnSeen());
  const DeformationState state = RandomState(strip.problem, 0.1, 7);
  Marginalization marginalization;
  Eliminate(strip.builder, Columns(2, 6), state, 0.0, &marginalization);
  // No data touch an eliminated node, so nothing has to be discarded.
  strip.builder.SetWeight(strip.data, 2.0);
  ASSERT_TRUE(marginalization.SetProblem(strip.builder, Columns(2, 6)).ok());
  EXPECT_TRUE(marginalization.has_factor());
  strip.builder.SetWeight(strip.rotation, 3.0);
  ASSERT_TRUE(marginalization.SetProblem(strip.builder, Columns(2, 6)).ok());
  EXPECT_FALSE(marginalization.has_factor());
  Eliminate(strip.builder, Columns(2, 6), state, 0.0, &marginalization);
  ASSERT_TRUE(marginalization.SetProblem(strip.builder, Columns(3, 6)).ok());
  EXPECT_FALSE(marginalization.has_factor());
  Eliminate(strip.builder, Columns(3, 6), state, 0.0, &marginalization);
  Marginalization fresh;
  Eliminate(strip.builder, Columns(3, 6), state, 0.0, &fresh);
  ExpectSamePrior(marginalization, fresh, 1e-15);
}

TEST(Marginalization, IsTheSameBitsOnAnyNumberOfThreads) {
  StripBuilder strip(OneColumnSeen());
  const DeformationState state = RandomState(strip.problem, 0.1, 7);
  Marginalization one;
  Eliminate(strip.builder, Columns(2, 6), state, 0.0, &one);
  for (const int threads : {2, 3}) {
    Marginalization many;
    ASSERT_TRUE(many.SetProblem(strip.builder, Columns(2, 6)).ok());
    ASSERT_TRUE(many.Linearize(state, threads));
    ASSERT_TRUE(many.Eliminate(0.0));
    ASSERT_TRUE(many.Update(state, threads));
    EXPECT_EQ(many.prior().quadratic().hessian, one.prior().quadratic().hessian);
    EXPECT_EQ(many.prior().quadratic().gradient, one.prior().quadratic().gradient);
    EXPECT_EQ(many.prior().quadratic().constant, one.prior().quadratic().constant);
  }
}

// Without a boundary nothing holds the nodes: a rigid motion costs nothing.
TEST(Marginalization, OfEveryNodeNeedsDampingAndHasNoBoundary) {
  StripBuilder strip(OneColumnSeen());
  strip.builder.SetWeight(strip.data, 0.0);
  strip.builder.SetWeight(strip.rotation, 0.0);
  const DeformationState state = RandomState(strip.problem, 0.1, 7);
  Marginalization marginalization;
  ASSERT_TRUE(marginalization.SetProblem(strip.builder, Columns(0, 6)).ok());
  EXPECT_TRUE(marginalization.boundary_nodes().empty());
  ASSERT_TRUE(marginalization.Linearize(state, 1));
  ASSERT_TRUE(marginalization.Eliminate(1e-4));
  EXPECT_EQ(marginalization.prior().size(), 0);
  DeformationState moved = state;
  marginalization.BackSubstitute(&moved);
  double energy = 0.0;
  ASSERT_TRUE(marginalization.EvaluateEnergy(moved, 1, &energy));
  EXPECT_LT(energy, 0.01 * marginalization.energy());
}

TEST(Marginalization, RefusesNodesThatAResidualJoinsToTheCamera) {
  StripBuilder strip(OneColumnSeen(true));
  Marginalization marginalization;
  const Status status = marginalization.SetProblem(strip.builder, Columns(1, 6));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.message(),
            "energy 'point_to_point' joins a node without observations to the camera, so that it "
            "can't be marginalised");
  EXPECT_TRUE(marginalization.SetProblem(strip.builder, Columns(2, 6)).ok());
}

}  // namespace
}  // namespace ceres_ed
