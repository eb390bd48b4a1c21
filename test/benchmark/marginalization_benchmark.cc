// Marginalising the PI nodes of a strip: 300 PR nodes at one end, all others PI.
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/residual_collection.h>

#include <cmath>
#include <memory>

#include <benchmark/benchmark.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

constexpr int kSeenNodes = 300;

int Rows(const benchmark::State& state) { return static_cast<int>(state.range(1)); }
int SeenColumns(const benchmark::State& state) { return kSeenNodes / Rows(state); }

// range(0) PI nodes, in rows of range(1).
TestProblemOptions Strip(const benchmark::State& state) {
  TestProblemOptions problem;
  problem.columns = SeenColumns(state) + static_cast<int>(state.range(0)) / Rows(state);
  problem.rows = Rows(state);
  problem.points_per_cell = 10;
  problem.observed_columns = SeenColumns(state) - 1;
  problem.target_deviation = 0.02;
  return problem;
}

// The seen part bends up by `lift` at its end.
void BendTargets(double lift, int seen_columns, StripBuilder* strip) {
  for (Correspondence& c : strip->problem.correspondences) {
    const double x = 1.0 - c.target.x() / seen_columns;
    c.target.z() += lift * x * x;
  }
  strip->builder.CollectResiduals(
      strip->data, **strip->registry.Create("point_to_plane", {}), strip->problem.Context());
}

void Sizes(benchmark::internal::Benchmark* sizes) {
  for (const int rows : {15, 50}) {
    for (const int nodes : {1000, 2500, 5000}) sizes->Args({nodes / rows * rows, rows});
  }
  sizes->Unit(benchmark::kMillisecond);
}

ProblemConfig PointIrrelevant(const StripBuilder& strip) {
  return LevelTwoConfig(strip.builder.PointRelevantNodes());
}

void Eliminate(benchmark::State& state) {
  const StripBuilder strip(Strip(state), "point_to_plane");
  const DeformationState rest(strip.problem.graph.num_nodes());
  Marginalization marginalization;
  if (!marginalization.SetProblem(strip.builder, PointIrrelevant(strip)).ok()) return;
  // The first one touches memory that the others find.
  marginalization.Linearize(rest, 1);
  marginalization.Eliminate(1e-12);
  for (auto _ : state) {
    marginalization.Linearize(rest, 1);
    marginalization.Eliminate(1e-12);
    benchmark::DoNotOptimize(marginalization.prior());
  }
  state.counters["boundary"] = static_cast<double>(marginalization.boundary_nodes().size());
}
BENCHMARK(Eliminate)->Apply(Sizes);

void UpdateGradient(benchmark::State& state) {
  const StripBuilder strip(Strip(state), "point_to_plane");
  DeformationState rest(strip.problem.graph.num_nodes());
  Marginalization marginalization;
  if (!marginalization.SetProblem(strip.builder, PointIrrelevant(strip)).ok()) return;
  marginalization.Linearize(rest, 1);
  marginalization.Eliminate(1e-12);
  for (auto _ : state) {
    marginalization.Update(rest, 1);
    marginalization.BackSubstitute(&rest);
  }
}
BENCHMARK(UpdateGradient)->Apply(Sizes);

// From rest to convergence.
void WholeSolve(benchmark::State& state, SolveMode mode) {
  StripBuilder strip(Strip(state), "point_to_plane");
  BendTargets(3.0, SeenColumns(state), &strip);
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
    BendTargets(0.05 * std::cos(0.3 * frame++), SeenColumns(state), &strip);
    state.ResumeTiming();
    energy = strategy->Solve(strip.builder, solver, &solution).final_energy;
  }
  state.counters["energy"] = energy;
}

BENCHMARK_CAPTURE(WholeSolve, Batch, SolveMode::kBatch)->Apply(Sizes);
BENCHMARK_CAPTURE(WholeSolve, TwoLevel, SolveMode::kTwoLevel)->Apply(Sizes);
BENCHMARK_CAPTURE(WholeSolve, Marginal, SolveMode::kMarginal)->Apply(Sizes);
BENCHMARK_CAPTURE(SolveAgain, Batch, SolveMode::kBatch)->Apply(Sizes);
BENCHMARK_CAPTURE(SolveAgain, TwoLevel, SolveMode::kTwoLevel)->Apply(Sizes);
BENCHMARK_CAPTURE(SolveAgain, Marginal, SolveMode::kMarginal)->Apply(Sizes);

}  // namespace
}  // namespace ceres_ed
