// A function of all points at once has the numbers of the same function of one point, in one call a
// step.
#include "ceres_ed/energy/batch_energy.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/linear_algebra/block_structure.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/testing/energy_laws.h>
#include <ceres_ed/testing/test_problem.h>

#include <cmath>
#include <memory>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::IsEmpty;

// The point's distance from a bowl, and its height.
struct BowlFunctor {
  static constexpr int kNumResiduals = 2;
  template <typename T>
  bool operator()(const T* point, T* residuals) const {
    residuals[0] = point[2] - 0.1 * (point[0] * point[0] + point[1] * point[1]);
    residuals[1] = 0.5 * point[2];
    return true;
  }
};

// The same for all points, with derivatives by hand.
class BowlFunction final : public PointBatchFunction {
 public:
  int NumResiduals(const PointBatch& at_rest) const override {
    points_at_rest = at_rest.count;
    return 2;
  }
  bool Evaluate(const PointBatch& batch,
                int /*num_residuals*/,
                double* residuals,
                double* jacobians) const override {
    ++calls;
    last_indices.assign(batch.indices, batch.indices + batch.count);
    last_normals.assign(batch.normals, batch.normals + 3 * batch.count);
    for (int k = 0; k < batch.count; ++k) {
      const double* const p = batch.points + 3 * k;
      residuals[2 * k] = p[2] - 0.1 * (p[0] * p[0] + p[1] * p[1]);
      residuals[2 * k + 1] = 0.5 * p[2];
      const double rows[6] = {-0.2 * p[0], -0.2 * p[1], 1.0, 0.0, 0.0, 0.5};
      std::copy_n(rows, 6, jacobians + 6 * k);
    }
    return !fails;
  }

  bool fails = false;
  mutable int calls = 0;
  mutable int points_at_rest = 0;
  mutable std::vector<int> last_indices;
  mutable std::vector<double> last_normals;
};

// Equations of one energy on a strip with a camera, linearised at a random state.
struct Linearized {
  explicit Linearized(const EnergyTerm& energy, const LossSpec& loss = {}) {
    TestProblemOptions options;
    options.has_camera = true;
    problem = MakeTestProblem(options);
    builder = std::make_unique<ProblemBuilder>(problem.graph, true);
    builder->CollectResiduals(
        builder->AddTerm("bowl", EnergyKind::kPrior, 2.0, loss), energy, problem.Context());
    equations.Build(*builder, FullConfig(problem.graph.num_nodes(), true));
    structure = std::make_unique<BlockStructure>(equations.BlockSizes(), equations.BlockPairs());
    EXPECT_TRUE(equations.SetStructure(structure.get()));
    state = RandomState(problem, 0.1, 5);
  }

  bool Evaluate(int num_threads) {
    return equations.Evaluate(state, num_threads, &cost, &values, &gradient);
  }

  TestProblem problem;
  std::unique_ptr<ProblemBuilder> builder;
  NormalEquations equations;
  std::unique_ptr<BlockStructure> structure;
  DeformationState state;
  double cost = 0.0;
  std::vector<double> values;
  Eigen::VectorXd gradient;
};

std::unique_ptr<EnergyTerm> Bowls() {
  return ForEachPoint(EnergyKind::kPrior, [](const EnergyContext&, int) { return BowlFunctor{}; });
}

class Losses : public ::testing::TestWithParam<LossType> {};

TEST_P(Losses, AreTheSameForOneFunctionOfAllPoints) {
  const LossSpec loss = {GetParam(), 0.3};
  const auto function = std::make_shared<const BowlFunction>();
  Linearized all(*ForAllPoints(EnergyKind::kPrior, function), loss);
  Linearized each(*Bowls(), loss);
  const int calls = function->calls;
  ASSERT_TRUE(all.Evaluate(1));
  EXPECT_EQ(function->calls, calls + 1) << "one call a step";
  EXPECT_EQ(function->points_at_rest, static_cast<int>(all.problem.points.size()));
  ASSERT_TRUE(each.Evaluate(1));
  EXPECT_NEAR(all.cost, each.cost, 1e-13 * each.cost);
  EXPECT_LT((all.gradient - each.gradient).norm(), 1e-12 * each.gradient.norm());
  ASSERT_EQ(all.values.size(), each.values.size());
  for (std::size_t i = 0; i < all.values.size(); ++i) {
    ASSERT_NEAR(all.values[i], each.values[i], 1e-10) << i;
  }
  const std::vector<double> values = all.values;
  ASSERT_TRUE(all.Evaluate(3));
  EXPECT_EQ(all.values, values) << "the threads change nothing";
}

INSTANTIATE_TEST_SUITE_P(All,
                         Losses,
                         ::testing::Values(LossType::kSquared, LossType::kHuber, LossType::kTukey));

TEST(ForAllPoints, SummariesAndChecksCallTheFunctionForAllPointsAtOnce) {
  const auto function = std::make_shared<const BowlFunction>();
  Linearized all(*ForAllPoints(EnergyKind::kPrior, function));
  Linearized each(*Bowls());
  const int calls = function->calls;
  const EnergySummary summary = all.builder->Evaluate(all.state);
  EXPECT_EQ(function->calls, calls + 1);
  EXPECT_NEAR(summary.Total(), each.builder->Evaluate(each.state).Total(), 1e-12);
  EXPECT_TRUE(all.builder->CheckResiduals(all.state).ok());
  EXPECT_EQ(function->calls, calls + 2);
}

TEST(ForAllPoints, ASelectionOfResidualsKeepsTheIndicesOfThePoints) {
  const auto function = std::make_shared<const BowlFunction>();
  Linearized all(*ForAllPoints(EnergyKind::kPrior, function));
  ProblemConfig config = FullConfig(all.problem.graph.num_nodes(), true);
  config.variable_nodes.assign(config.variable_nodes.size(), 0);
  config.variable_nodes[0] = 1;
  config.camera_variable = false;
  all.equations.Build(*all.builder, config);
  const BlockStructure structure(all.equations.BlockSizes(), all.equations.BlockPairs());
  ASSERT_TRUE(all.equations.SetStructure(&structure));
  ASSERT_TRUE(all.Evaluate(1));
  std::vector<int> expected;
  for (int p = 0; p < static_cast<int>(all.problem.points.size()); ++p) {
    const Binding binding = all.problem.skinning[p];
    for (int i = 0; i < binding.size; ++i) {
      if (binding.nodes[i] == 0) expected.push_back(p);
    }
  }
  EXPECT_EQ(function->last_indices, expected);
  EXPECT_LT(expected.size(), all.problem.points.size());
}

// A rigid motion turns the normals with the surface.
TEST(ForAllPoints, GivesTheNormalsOfTheWarpedSurface) {
  const auto function = std::make_shared<const BowlFunction>();
  const TestProblem problem = MakeTestProblem({});
  EnergyContext context = problem.Context();
  const std::vector<Eigen::Vector3d> normals(problem.points.size(), Eigen::Vector3d::UnitZ());
  context.normals = &normals;
  ProblemBuilder builder(problem.graph, false);
  builder.CollectResiduals(builder.AddTerm("bowl", EnergyKind::kPrior),
                           *ForAllPoints(EnergyKind::kPrior, function),
                           context);
  CameraPose motion;
  motion.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  motion.translation = Eigen::Vector3d(3, 2, 1);
  builder.Evaluate(RigidState(problem.graph, motion));
  ASSERT_EQ(function->last_normals.size(), 3 * problem.points.size());
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> normal(&function->last_normals[3 * i]);
    EXPECT_LT((normal - motion.rotation * Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  }
}

TEST(ForAllPoints, AFunctionThatFailsFailsTheEquations) {
  const auto function = std::make_shared<BowlFunction>();
  Linearized all(*ForAllPoints(EnergyKind::kPrior, function));
  function->fails = true;
  EXPECT_FALSE(all.Evaluate(1));
  EXPECT_TRUE(std::isnan(all.builder->Evaluate(all.state).Total()));
  EXPECT_THAT(all.builder->CheckResiduals(all.state).message(),
              ::testing::HasSubstr("energy 'bowl': residual 0"));
}

TEST(ForAllPoints, ObeysTheLaws) {
  EnergyRegistry registry;
  EnergyInfo info;
  info.name = "bowl";
  info.summary = "draws points to a bowl";
  info.equation = "p_z - (p_x^2 + p_y^2) / 10, p_z / 2";
  info.unit = "map unit";
  const auto function = std::make_shared<const BowlFunction>();
  ASSERT_TRUE(registry
                  .Register(info,
                            [function](const ParameterValues&) {
                              return ForAllPoints(EnergyKind::kPrior, function);
                            })
                  .ok());
  for (const bool has_camera : {false, true}) {
    EnergyClaims claims;
    claims.squared_norm_at_rest = std::nullopt;
    claims.problem.has_camera = has_camera;
    EXPECT_THAT(CheckEnergyLaws(registry, "bowl", claims), IsEmpty());
  }
}

}  // namespace
}  // namespace ceres_ed
