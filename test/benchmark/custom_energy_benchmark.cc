// What an energy of a user's costs beside a built-in one of the same arithmetic: collecting its
// residuals and a step of Level I with them, over 400 nodes and a camera. Its functors are those of
// the built-in energies under other names, by way of ForEachMatch, ForEachNode and ForEachEdge.
#include <ceres_ed/energy/custom_energy.h>
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <cost_functions/regularization_cost.h>
#include <cost_functions/rotation_cost.h>

namespace ceres_ed {
namespace {

// n . (p - q)
struct MyPlane {
  static constexpr int kNumResiduals = 1;
  template <typename T>
  bool operator()(const T* point, T* residual) const {
    residual[0] = normal.x() * (point[0] - target.x()) + normal.y() * (point[1] - target.y()) +
                  normal.z() * (point[2] - target.z());
    return true;
  }
  Eigen::Vector3d target;
  Eigen::Vector3d normal;
};

struct MyNodePrior {
  static constexpr int kNumResiduals = 3;
  template <typename T>
  bool operator()(const T* node, T* residuals) const {
    for (int i = 0; i < 3; ++i) residuals[i] = NodeTranslation(node)[i] - T(translation[i]);
    return true;
  }
  Eigen::Vector3d translation;
};

std::unique_ptr<EnergyTerm> MakeCustom(const std::string& name) {
  if (name == "point_to_plane") {
    return ForEachMatch([](const Correspondence& c) { return MyPlane{c.target, c.normal}; });
  }
  if (name == "node_prior") {
    return ForEachNode(EnergyKind::kPrior, [](const EnergyContext& context, int j) {
      return MyNodePrior{(*context.node_prior)[j]};
    });
  }
  if (name == "rotation") {
    return ForEachNode(EnergyKind::kPrior,
                       [](const EnergyContext&, int) { return RotationCost(); });
  }
  return ForEachEdge(EnergyKind::kPrior, [](const EnergyContext& context, const GraphEdge& edge) {
    return RegularizationCost(
        context.graph->position(edge.from), context.graph->position(edge.to), edge.weight);
  });
}

// One step with all energies of a frame, of which `replaced` is the user's.
void Step(benchmark::State& state, const char* replaced) {
  TestProblemOptions options;
  options.columns = 20;
  options.rows = 20;
  options.points_per_cell = static_cast<int>(state.range(0));
  options.has_camera = true;
  options.target_deviation = 0.05;
  const TestProblem problem = MakeTestProblem(options);
  const EnergyRegistry registry = BuiltinEnergies();
  ProblemBuilder builder(problem.graph, /*has_camera=*/true);
  std::vector<std::unique_ptr<EnergyTerm>> terms;
  for (const std::string name :
       {"rotation", "regularization", "node_prior", "pose_prior", "point_to_plane"}) {
    terms.push_back(name == replaced ? MakeCustom(name) : *registry.Create(name, {}));
    builder.AddTerm(name, terms.back()->kind(), 1.0);
  }
  const ProblemConfig config = FullConfig(problem.graph.num_nodes(), true);
  SolverOptions step;
  step.max_iterations = 1;
  const std::unique_ptr<LevelSolver> solver = MakeLevelSolver(LinearSolver::kBlock);
  for (auto _ : state) {
    for (std::size_t t = 0; t < terms.size(); ++t) {
      builder.CollectResiduals(static_cast<int>(t), *terms[t], problem.Context());
    }
    DeformationState solution(problem.graph.num_nodes());
    SolveSummary summary;
    solver->Solve(builder, config, step, &solution, &summary);
    benchmark::DoNotOptimize(summary);
  }
}

// Points a cell, of 361 cells.
#define CERES_ED_STEP(name, replaced) \
  BENCHMARK_CAPTURE(Step, name, replaced)->Arg(28)->Unit(benchmark::kMillisecond)
CERES_ED_STEP(all_built_in, "");
CERES_ED_STEP(custom_point_to_plane, "point_to_plane");
CERES_ED_STEP(custom_node_prior, "node_prior");
CERES_ED_STEP(custom_rotation, "rotation");
CERES_ED_STEP(custom_regularization, "regularization");

// The term alone: collecting it, and its part of the normal equations with all derivatives.
void Term(benchmark::State& state, const char* name, bool custom) {
  TestProblemOptions options;
  options.columns = 20;
  options.rows = 20;
  options.points_per_cell = 28;
  options.has_camera = true;
  options.target_deviation = 0.05;
  const TestProblem problem = MakeTestProblem(options);
  const EnergyRegistry registry = BuiltinEnergies();
  const std::unique_ptr<EnergyTerm> term = custom ? MakeCustom(name) : *registry.Create(name, {});
  ProblemBuilder builder(problem.graph, /*has_camera=*/true);
  builder.AddTerm(name, term->kind(), 1.0);
  builder.CollectResiduals(0, *term, problem.Context());
  NormalEquations equations(builder, FullConfig(problem.graph.num_nodes(), true));
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  equations.SetStructure(&structure);
  const DeformationState rest(problem.graph.num_nodes());
  double cost = 0.0;
  std::vector<double> values;
  Eigen::VectorXd gradient;
  for (auto _ : state) {
    builder.CollectResiduals(0, *term, problem.Context());
    equations.Build(builder, FullConfig(problem.graph.num_nodes(), true));
    equations.SetStructure(&structure);
    equations.Evaluate(rest, 1, &cost, &values, &gradient);
  }
}

#define CERES_ED_TERM(name)                                                              \
  BENCHMARK_CAPTURE(Term, name##_built_in, #name, false)->Unit(benchmark::kMicrosecond); \
  BENCHMARK_CAPTURE(Term, name##_custom, #name, true)->Unit(benchmark::kMicrosecond)
CERES_ED_TERM(point_to_plane);
CERES_ED_TERM(node_prior);
CERES_ED_TERM(rotation);
CERES_ED_TERM(regularization);

}  // namespace
}  // namespace ceres_ed
