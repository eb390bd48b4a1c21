// One iteration of Level I on a window of 20 x 20 nodes and a camera, in maps of growing length.
#include <ceres_ed/solver/level_solver.h>

#include <memory>

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
      strip.problem.graph, strip.builder.PointRelevantNodes(), true, SeamEdges::kKeep, 0);
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

}  // namespace
}  // namespace ceres_ed
