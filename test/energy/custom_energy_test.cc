// Energies as a user would write them, one for each way to define them. They obey the laws of the
// built-in ones, and all solvers accept them.
#include "ceres_ed/energy/custom_energy.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/energy_laws.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <ceres/solver.h>
#include <cost_functions/regularization_cost.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ceres_ed {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;

// Draws points to a plane.
struct PlaneFunctor {
  static constexpr int kNumResiduals = 1;
  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = normal.x() * point[0] + normal.y() * point[1] + normal.z() * point[2] - offset;
    return true;
  }
  Eigen::Vector3d normal;
  double offset;
};

// The expected translation of a node is 0.
struct AnchorFunctor {
  static constexpr int kNumResiduals = 3;
  template <typename T>
  bool operator()(const T* node, T* residuals) const {
    for (int i = 0; i < 3; ++i) residuals[i] = gain * NodeTranslation(node)[i];
    return true;
  }
  double gain;
};

// Both ends of an edge move in the same way.
struct ShearFunctor {
  static constexpr int kNumResiduals = 3;
  template <typename T>
  bool operator()(const T* from, const T* to, T* residuals) const {
    for (int i = 0; i < 3; ++i) residuals[i] = NodeTranslation(from)[i] - NodeTranslation(to)[i];
    return true;
  }
};

// A node keeps its distance from the camera's centre -R_c^T T_c, which is |R_c x + T_c|.
struct LeashFunctor {
  static constexpr int kNumResiduals = 1;
  template <typename T>
  bool operator()(const T* node, const T* rotation, const T* translation, T* residual) const {
    const Eigen::Matrix<T, 3, 1> in_map = position.cast<T>() + NodeTranslation(node);
    residual[0] = MapToCamera(rotation, translation, in_map).squaredNorm() - T(squared_length);
    return true;
  }
  Eigen::Vector3d position;
  double squared_length;
};

// Two points keep the distance that they have at rest.
struct RodFunctor {
  static constexpr int kNumResiduals = 1;
  template <typename T>
  bool operator()(const T* a, const T* b, T* residual) const {
    T squared = T(0.0);
    for (int i = 0; i < 3; ++i) squared += (a[i] - b[i]) * (a[i] - b[i]);
    residual[0] = squared - T(squared_length);
    return true;
  }
  double squared_length;
};

std::unique_ptr<EnergyTerm> MakePlane(const ParameterValues&) {
  return ForEachMatch([](const Correspondence& c) {
    return PlaneFunctor{c.normal, c.normal.dot(c.target)};
  });
}

std::unique_ptr<EnergyTerm> MakeAnchor(const ParameterValues& values) {
  const AnchorFunctor anchor{values.Get("gain")};
  return ForEachNode(EnergyKind::kPrior, [anchor](const EnergyContext&, int) { return anchor; });
}

std::unique_ptr<EnergyTerm> MakeShear(const ParameterValues&) {
  return ForEachEdge(EnergyKind::kPrior,
                     [](const EnergyContext&, const GraphEdge&) { return ShearFunctor{}; });
}

std::unique_ptr<EnergyTerm> MakeLeash(const ParameterValues&) {
  return MakeEnergy(EnergyKind::kPrior, [](const EnergyContext& context, ResidualSink* sink) {
    if (!context.has_camera) return;
    for (int j = 0; j < context.graph->num_nodes(); ++j) {
      const Eigen::Vector3d& g = context.graph->position(j);
      AddBlockResidual(sink,
                       1.0,
                       LeashFunctor{g, (context.camera_prior * g).squaredNorm()},
                       NodeBlock{j},
                       CameraRotationBlock{},
                       CameraTranslationBlock{});
    }
  });
}

std::unique_ptr<EnergyTerm> MakeRods(const ParameterValues&) {
  return MakeEnergy(EnergyKind::kPrior, [](const EnergyContext& context, ResidualSink* sink) {
    const std::vector<Eigen::Vector3d>& points = *context.points;
    for (int i = 0; i + 1 < static_cast<int>(points.size()); ++i) {
      const RodFunctor rod{(points[i] - points[i + 1]).squaredNorm()};
      AddPointsResidual(context, std::array<int, 2>{i, i + 1}, rod, 1.0, sink);
    }
  });
}

struct Custom {
  const char* name;
  EnergyKind kind;
  EnergyRegistry::Factory factory;
};

const std::vector<Custom>& Customs() {
  static const std::vector<Custom> customs = {{"plane", EnergyKind::kObservation, MakePlane},
                                              {"anchor", EnergyKind::kPrior, MakeAnchor},
                                              {"shear", EnergyKind::kPrior, MakeShear},
                                              {"leash", EnergyKind::kPrior, MakeLeash},
                                              {"rods", EnergyKind::kPrior, MakeRods}};
  return customs;
}

EnergyRegistry Registry() {
  EnergyRegistry registry = BuiltinEnergies();
  for (const Custom& custom : Customs()) {
    EnergyInfo info{custom.name, "a test", "r", "-", custom.kind, {}, ""};
    if (info.name == "anchor") info.parameters = {RealParameter("gain", "-", 0.5, 2, 1, "factor")};
    EXPECT_TRUE(registry.Register(info, custom.factory).ok());
  }
  return registry;
}

// A strip with a camera, with the energies that it needs to be solved and one energy of the user.
class CustomProblem {
 public:
  explicit CustomProblem(const std::string& name, double weight = 1.0, const LossSpec& loss = {})
      : problem_(MakeTestProblem(Options())), registry_(Registry()) {
    builder_ = std::make_unique<ProblemBuilder>(problem_.graph, /*has_camera=*/true);
    for (const char* builtin :
         {"rotation", "regularization", "node_prior", "pose_prior", "point_to_point"}) {
      Add(builtin, 1.0, {});
    }
    custom_ = Add(name, weight, loss);
  }

  const ProblemBuilder& builder() const { return *builder_; }
  int custom() const { return custom_; }
  DeformationState Start() const { return DeformationState(problem_.graph.num_nodes()); }

 private:
  // Half of the strip is visible.
  static TestProblemOptions Options() {
    TestProblemOptions options;
    options.has_camera = true;
    options.observed_columns = 2;
    options.target_deviation = 0.2;
    return options;
  }

  int Add(const std::string& name, double weight, const LossSpec& loss) {
    const auto energy = registry_.Create(name, {});
    EXPECT_TRUE(energy.ok()) << energy.status().message();
    const int term = builder_->AddTerm(name, (*energy)->kind(), weight, loss);
    builder_->CollectResiduals(term, **energy, problem_.Context());
    return term;
  }

  TestProblem problem_;
  EnergyRegistry registry_;
  std::unique_ptr<ProblemBuilder> builder_;
  int custom_ = -1;
};

SolverOptions Tight() {
  SolverOptions options;
  options.max_iterations = 200;
  options.function_tolerance = 1e-13;
  return options;
}

class CustomEnergy : public ::testing::TestWithParam<int> {
 protected:
  std::string name() const { return Customs()[GetParam()].name; }
};

TEST_P(CustomEnergy, ObeysTheLaws) {
  EnergyClaims claims;
  if (name() == "leash") claims.problem.has_camera = true;
  EXPECT_THAT(CheckEnergyLaws(Registry(), name(), claims), IsEmpty());
}

TEST_P(CustomEnergy, HasTheSameMinimumByEveryWayToSolve) {
  const CustomProblem problem(name(), 3.0);
  double reference = -1.0;
  for (const LinearSolver linear_solver : {LinearSolver::kCeres, LinearSolver::kBlock}) {
    for (const SolveMode mode : {SolveMode::kBatch, SolveMode::kMarginal}) {
      StrategyOptions strategy;
      strategy.mode = mode;
      strategy.linear_solver = linear_solver;
      strategy.rings = 0;
      DeformationState state = problem.Start();
      const SolveSummary summary =
          MakeStrategy(strategy)->Solve(problem.builder(), Tight(), &state);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      if (reference < 0.0) reference = summary.final_energy;
      EXPECT_NEAR(summary.final_energy, reference, 1e-6 * reference) << summary.message;
      EXPECT_LT(summary.final_energy, summary.initial_energy);
    }
  }
}

TEST_P(CustomEnergy, IsSolvedInTwoLevels) {
  const CustomProblem problem(name(), 3.0);
  std::vector<double> energies;
  for (const LinearSolver linear_solver : {LinearSolver::kCeres, LinearSolver::kBlock}) {
    StrategyOptions strategy;
    strategy.mode = SolveMode::kTwoLevel;
    strategy.linear_solver = linear_solver;
    strategy.rings = 0;
    DeformationState state = problem.Start();
    const SolveSummary summary = MakeStrategy(strategy)->Solve(problem.builder(), Tight(), &state);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    ASSERT_EQ(summary.levels.size(), 2u);
    EXPECT_GT(summary.levels[0].num_variable_nodes, 0);
    EXPECT_GT(summary.levels[1].num_variable_nodes, 0);
    energies.push_back(summary.final_energy);
  }
  EXPECT_NEAR(energies[0], energies[1], 1e-6 * energies[0]);
}

TEST_P(CustomEnergy, LeavesHeldBlocksAsTheyAre) {
  const CustomProblem problem(name());
  ProblemConfig config = FullConfig(problem.builder().graph().num_nodes(), true);
  for (std::size_t j = 0; j < config.variable_nodes.size(); j += 2) config.variable_nodes[j] = 0;
  config.camera_variable = false;
  DeformationState state = problem.Start();
  BuiltProblem built = problem.builder().Build(config, &state);
  ceres::Solver::Summary summary;
  ceres::Solve({}, built.problem.get(), &summary);
  ASSERT_TRUE(summary.IsSolutionUsable());
  const DeformationState rest = problem.Start();
  int moved = 0;
  for (int j = 0; j < state.num_nodes(); ++j) {
    const bool is_same = std::equal(state.node(j), state.node(j) + kNodeSize, rest.node(j));
    if (config.variable_nodes[j] == 0) {
      EXPECT_TRUE(is_same) << j;
    } else {
      moved += is_same ? 0 : 1;
    }
  }
  EXPECT_GT(moved, 0);
  EXPECT_EQ(state.camera_from_map.translation, rest.camera_from_map.translation);
}

TEST_P(CustomEnergy, TakesWeightAndLoss) {
  DeformationState state = CustomProblem(name()).Start();
  for (int j = 0; j < state.num_nodes(); ++j) {
    MutableNodeTranslation(state.node(j)) = Eigen::Vector3d(0.1 * j, 0.4, -0.2);
  }
  const auto energy_of = [&](double weight, const LossSpec& loss) {
    const CustomProblem problem(name(), weight, loss);
    return problem.builder().Evaluate(state).terms[problem.custom()];
  };
  const TermEnergy plain = energy_of(1.0, {});
  ASSERT_GT(plain.raw, 0.0);
  EXPECT_DOUBLE_EQ(energy_of(2.5, {}).weighted, 2.5 * plain.weighted);
  const TermEnergy robust = energy_of(1.0, {LossType::kHuber, 1e-3});
  EXPECT_EQ(robust.raw, plain.raw);
  EXPECT_LT(robust.weighted, plain.weighted);
}

TEST_P(CustomEnergy, MakesNodesPointRelevantWhereItIsAnObservation) {
  TestProblemOptions options;
  options.observed_columns = 2;
  options.has_camera = true;
  const TestProblem problem = MakeTestProblem(options);
  ProblemBuilder builder(problem.graph, /*has_camera=*/true);
  const auto energy = Registry().Create(name(), {});
  ASSERT_TRUE(energy.ok());
  const int term = builder.AddTerm(name(), (*energy)->kind());
  builder.CollectResiduals(term, **energy, problem.Context());
  ASSERT_GT(builder.NumResidualBlocks(term), 0);
  const std::vector<char> relevant = builder.PointRelevantNodes();
  if ((*energy)->kind() == EnergyKind::kPrior) {
    EXPECT_THAT(relevant, Each(0));
  } else {
    // Two columns of cells have three columns of three nodes.
    EXPECT_EQ(std::count(relevant.begin(), relevant.end(), 1), 9);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryWayIn, CustomEnergy, ::testing::Range(0, 5), [](const auto& info) {
  return std::string(Customs()[info.param].name);
});

TEST(ForEachEdge, HasTheNumbersOfTheBuiltInEnergyOfTheSameFunctor) {
  const TestProblem problem = MakeTestProblem({});
  const auto mine =
      ForEachEdge(EnergyKind::kPrior, [](const EnergyContext& context, const GraphEdge& edge) {
        const DeformationGraph& graph = *context.graph;
        return RegularizationCost(graph.position(edge.from), graph.position(edge.to), edge.weight);
      });
  ProblemBuilder builder(problem.graph, /*has_camera=*/false);
  const int custom = builder.AddTerm("mine", EnergyKind::kPrior);
  builder.CollectResiduals(custom, *mine, problem.Context());
  const int builtin = builder.AddTerm("regularization", EnergyKind::kPrior);
  builder.CollectResiduals(builtin, **Registry().Create("regularization", {}), problem.Context());
  const EnergySummary summary = builder.Evaluate(RandomState(problem, 0.1, 5));
  EXPECT_GT(summary.terms[custom].raw, 0.0);
  EXPECT_EQ(summary.terms[custom].raw, summary.terms[builtin].raw);
  EXPECT_EQ(summary.terms[custom].residuals, summary.terms[builtin].residuals);
}

TEST(ForEachPoint, LeavesOutPointsWithoutAFunctor) {
  const TestProblem problem = MakeTestProblem({});
  const auto energy = ForEachPoint(EnergyKind::kPrior,
                                   [](const EnergyContext&, int i) -> std::optional<PlaneFunctor> {
                                     if (i % 2 == 1) return std::nullopt;
                                     return PlaneFunctor{Eigen::Vector3d::UnitX(), 0.0};
                                   });
  ProblemBuilder builder(problem.graph, /*has_camera=*/false);
  const int term = builder.AddTerm("half", EnergyKind::kPrior);
  builder.CollectResiduals(term, *energy, problem.Context());
  EXPECT_EQ(builder.NumResidualBlocks(term), static_cast<int>(problem.points.size() + 1) / 2);
}

TEST(PointFrame, OfTheMapLeavesTheCameraOut) {
  TestProblemOptions options;
  options.has_camera = true;
  const TestProblem problem = MakeTestProblem(options);
  for (const PointFrame frame : {PointFrame::kMap, PointFrame::kObserved}) {
    const auto energy = ForEachPoint(
        EnergyKind::kPrior,
        [](const EnergyContext&, int) {
          return PlaneFunctor{Eigen::Vector3d::UnitX(), 0.0};
        },
        frame);
    ProblemBuilder builder(problem.graph, /*has_camera=*/true);
    const int term = builder.AddTerm("x", EnergyKind::kPrior);
    builder.CollectResiduals(term, *energy, problem.Context());
    DeformationState state(problem.graph.num_nodes());
    const double before = builder.Evaluate(state).Total();
    state.camera_from_map.translation.x() += 3.0;
    if (frame == PointFrame::kMap) {
      EXPECT_EQ(builder.Evaluate(state).Total(), before);
    } else {
      EXPECT_GT(builder.Evaluate(state).Total(), before);
    }
  }
}

}  // namespace
}  // namespace ceres_ed
