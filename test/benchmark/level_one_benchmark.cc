// One iteration of Level I on a window of 20 x 20 nodes and a camera, in maps of growing length;
// and what it is made of before anything is factorised.
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/testing/residual_collection.h>

#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

void LevelOneIteration(benchmark::State& state, LinearSolver linear_solver) {
  TestProblemOptions problem;
  problem.columns = static_cast<int>(state.range(0));
  problem.rows = 20;
  problem.points_per_cell = 10;
  problem.observed_columns = 19;
  problem.has_camera = true;
  problem.target_deviation = 0.05;
  const StripBuilder strip(problem, "point_to_plane");
  const ProblemConfig config = LevelOneConfig(
      strip.problem.graph, strip.builder.PointRelevantNodes(), true, BoundaryEdges::kKeep, 0);
  SolverOptions options;
  options.max_iterations = 1;
  const std::unique_ptr<LevelSolver> solver = MakeLevelSolver(linear_solver);
  for (auto _ : state) {
    state.PauseTiming();
    DeformationState solution(strip.problem.graph.num_nodes());
    state.ResumeTiming();
    SolveSummary summary;
    solver->Solve(strip.builder, config, options, &solution, &summary);
    benchmark::DoNotOptimize(summary);
  }
  state.counters["nodes"] = strip.problem.graph.num_nodes();
  state.counters["variable"] = config.NumVariableNodes();
}
BENCHMARK_CAPTURE(LevelOneIteration, Block, LinearSolver::kBlock)
    ->Arg(20)
    ->Arg(80)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(LevelOneIteration, Ceres, LinearSolver::kCeres)
    ->Arg(20)
    ->Arg(80)
    ->Unit(benchmark::kMillisecond);

// 20 x 20 nodes and a camera, `points_per_cell` in each of 361 cells.
struct Window {
  explicit Window(int points_per_cell) : strip(Options(points_per_cell), "point_to_plane") {}

  static TestProblemOptions Options(int points_per_cell) {
    TestProblemOptions options;
    options.columns = 20;
    options.rows = 20;
    options.points_per_cell = points_per_cell;
    options.has_camera = true;
    options.target_deviation = 0.05;
    return options;
  }

  StripBuilder strip;
  ProblemConfig config = FullConfig(400, true);
};

void CollectPoints(benchmark::State& state) {
  Window window(static_cast<int>(state.range(0)));
  const auto energy = window.strip.registry.Create("point_to_plane", {});
  for (auto _ : state) {
    window.strip.builder.CollectResiduals(
        window.strip.data, **energy, window.strip.problem.Context());
  }
}

void BuildEquations(benchmark::State& state) {
  const Window window(static_cast<int>(state.range(0)));
  NormalEquations equations(window.strip.builder, window.config);
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  for (auto _ : state) {
    equations.Build(window.strip.builder, window.config);
    benchmark::DoNotOptimize(equations.SetStructure(&structure));
  }
}

void EvaluateEquations(benchmark::State& state) {
  const Window window(static_cast<int>(state.range(0)));
  NormalEquations equations(window.strip.builder, window.config);
  const BlockStructure structure(equations.BlockSizes(), equations.BlockPairs());
  equations.SetStructure(&structure);
  const DeformationState rest(400);
  double cost = 0.0;
  std::vector<double> values;
  Eigen::VectorXd gradient;
  for (auto _ : state) {
    equations.Evaluate(rest, static_cast<int>(state.range(1)), &cost, &values, &gradient);
  }
}

// Points a cell: 77,000 and 10,000 points; threads.
BENCHMARK(CollectPoints)->Arg(213)->Arg(28)->Unit(benchmark::kMillisecond);
BENCHMARK(BuildEquations)->Arg(213)->Arg(28)->Unit(benchmark::kMillisecond);
BENCHMARK(EvaluateEquations)
    ->Args({213, 1})
    ->Args({213, 2})
    ->Args({28, 1})
    ->Args({28, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace ceres_ed
