// Marginalising the PI nodes of a strip: 20 x 15 PR nodes at one end, all others PI.
#include <ceres_ed/solver/marginalization.h>
#include <ceres_ed/solver/strategy.h>

#include <cmath>
#include <memory>

#include <benchmark/benchmark.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

constexpr int kRows = 15;
constexpr int kSeenColumns = 20;

// range(0) PI nodes.
TestProblemOptions Strip(const benchmark::State& state) {
  TestProblemOptions problem;
  problem.columns = kSeenColumns + static_cast<int>(state.range(0)) / kRows;
  problem.rows = kRows;
  problem.points_per_cell = 10;
  problem.observed_columns = kSeenColumns - 1;
  problem.target_deviation = 0.02;
  return problem;
}

// The seen part bends up by `lift` at its end.
void BendTargets(double lift, StripBuilder* strip) {
  for (Correspondence& c : strip->problem.correspondences) {
    const double x = 1.0 - c.target.x() / kSeenColumns;
    c.target.z() += lift * x * x;
  }
  strip->builder.CollectResiduals(
      strip->data, **strip->registry.Create("point_to_plane", {}), strip->problem.Context());
}

ProblemConfig PointIrrelevant(const StripBuilder& strip) {
  return LevelTwoConfig(strip.builder.PointRelevantNodes());
}

void Eliminate(benchmark::State& state) {
  const StripBuilder strip(Strip(state), "point_to_plane");
  const DeformationState rest(strip.problem.graph.num_nodes());
  Marginalization marginalization;
  if (!marginalization.SetProblem(strip.builder, PointIrrelevant(strip)).ok()) return;
  for (auto _ : state) {
    marginalization.Linearize(rest, 1);
    marginalization.Eliminate(1e-8);
    benchmark::DoNotOptimize(marginalization.prior());
  }
  state.counters["seam"] = static_cast<double>(marginalization.seam_nodes().size());
}
BENCHMARK(Eliminate)->Arg(1005)->Arg(2505)->Arg(5010)->Unit(benchmark::kMillisecond);

void UpdateGradient(benchmark::State& state) {
  const StripBuilder strip(Strip(state), "point_to_plane");
  DeformationState rest(strip.problem.graph.num_nodes());
  Marginalization marginalization;
  if (!marginalization.SetProblem(strip.builder, PointIrrelevant(strip)).ok()) return;
  marginalization.Linearize(rest, 1);
  marginalization.Eliminate(1e-8);
  for (auto _ : state) {
    marginalization.Update(rest, 1);
    marginalization.BackSubstitute(&rest);
  }
}
BENCHMARK(UpdateGradient)->Arg(1005)->Arg(2505)->Arg(5010)->Unit(benchmark::kMillisecond);

// From rest to convergence.
void WholeSolve(benchmark::State& state, SolveMode mode) {
  StripBuilder strip(Strip(state), "point_to_plane");
  BendTargets(3.0, &strip);
  StrategyOptions options;
  options.mode = mode;
  SolveSummary summary;
  for (auto _ : state) {
    DeformationState solution(strip.problem.graph.num_nodes());
    summary = MakeStrategy(options)->Solve(strip.builder, {}, &solution);
    benchmark::DoNotOptimize(summary);
  }
  state.counters["iterations"] = summary.levels.back().iterations;
  state.counters["energy"] = summary.final_energy;
}

// A strategy that stays, and correspondences that move a little from solve to solve, of two
// iterations each.
void SolveAgain(benchmark::State& state, SolveMode mode) {
  StripBuilder strip(Strip(state), "point_to_plane");
  StrategyOptions options;
  options.mode = mode;
  const std::unique_ptr<Strategy> strategy = MakeStrategy(options);
  SolverOptions solver;
  solver.max_iterations = 2;
  DeformationState solution(strip.problem.graph.num_nodes());
  strategy->Solve(strip.builder, {}, &solution);
  double energy = 0.0;
  int frame = 0;
  for (auto _ : state) {
    state.PauseTiming();
    BendTargets(0.05 * std::cos(0.3 * frame++), &strip);
    state.ResumeTiming();
    energy = strategy->Solve(strip.builder, solver, &solution).final_energy;
  }
  state.counters["energy"] = energy;
}

#define CERES_ED_BENCHMARK_MODES(function)                    \
  BENCHMARK_CAPTURE(function, Batch, SolveMode::kBatch)       \
      ->Arg(1005)                                             \
      ->Arg(2505)                                             \
      ->Arg(5010)                                             \
      ->Unit(benchmark::kMillisecond);                        \
  BENCHMARK_CAPTURE(function, TwoLevel, SolveMode::kTwoLevel) \
      ->Arg(1005)                                             \
      ->Arg(2505)                                             \
      ->Arg(5010)                                             \
      ->Unit(benchmark::kMillisecond);                        \
  BENCHMARK_CAPTURE(function, Marginal, SolveMode::kMarginal) \
      ->Arg(1005)                                             \
      ->Arg(2505)                                             \
      ->Arg(5010)                                             \
      ->Unit(benchmark::kMillisecond)
CERES_ED_BENCHMARK_MODES(WholeSolve);
CERES_ED_BENCHMARK_MODES(SolveAgain);
#undef CERES_ED_BENCHMARK_MODES

}  // namespace
}  // namespace ceres_ed
