// The parts of a factorisation: analysis, numeric factor and solve, on sheets of nodes that are
// joined to their 8 neighbours. "Points" stands for nodes that share points, so that their affine
// parts are coupled, "Edges" for nodes that share edges alone.
#include <ceres_ed/linear_algebra/block_cholesky.h>

#include <algorithm>
#include <vector>

#include <benchmark/benchmark.h>

namespace ceres_ed {
namespace {

BlockStructure Sheet(int columns, int rows, bool share_points) {
  std::vector<BlockPair> pairs;
  for (int x = 0; x < columns; ++x) {
    for (int y = 0; y < rows; ++y) {
      for (int dx = 0; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          if (x + dx >= columns || y + dy < 0 || y + dy >= rows || (dx == 0 && dy != 1)) continue;
          pairs.push_back({x * rows + y, (x + dx) * rows + y + dy, share_points});
        }
      }
    }
  }
  return BlockStructure(std::vector<int>(static_cast<std::size_t>(columns) * rows, 12), pairs);
}

// Small off the diagonal, so that the sum below is positive definite.
std::vector<double> Values(const BlockStructure& structure) {
  std::vector<double> values(structure.num_values());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1e-2 * (i % 7);
  return values;
}

void Analyze(benchmark::State& state, bool share_points) {
  const BlockStructure structure = Sheet(state.range(0), state.range(1), share_points);
  for (auto _ : state) {
    const BlockCholesky cholesky(structure);
    benchmark::DoNotOptimize(&cholesky);
  }
}

void Factorize(benchmark::State& state, bool share_points) {
  const BlockStructure structure = Sheet(state.range(0), state.range(1), share_points);
  const std::vector<double> values = Values(structure);
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Constant(structure.num_rows(), 100.0);
  BlockCholesky cholesky(structure);
  for (auto _ : state) {
    benchmark::DoNotOptimize(cholesky.Factorize(values.data(), diagonal, state.range(2)));
  }
  state.counters["values_MB"] = 8e-6 * structure.num_values();
  state.counters["factor_MB"] = 8e-6 * cholesky.NumValues();
  state.counters["GFLOP"] = 2e-9 * cholesky.NumOperations();
  state.counters["GFLOP/s"] = benchmark::Counter(
      2e-9 * cholesky.NumOperations() * state.iterations(), benchmark::Counter::kIsRate);
}

void Solve(benchmark::State& state, bool share_points) {
  const BlockStructure structure = Sheet(state.range(0), state.range(1), share_points);
  BlockCholesky cholesky(structure);
  cholesky.Factorize(Values(structure).data(),
                     Eigen::VectorXd::Constant(structure.num_rows(), 100.0));
  const Eigen::VectorXd rhs = Eigen::VectorXd::LinSpaced(structure.num_rows(), -1.0, 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(cholesky.Solve(rhs));
}

BENCHMARK_CAPTURE(Analyze, Points, true)->Args({20, 20})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Analyze, Edges, false)
    ->Args({20, 20})
    ->Args({141, 141})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Factorize, Points, true)
    ->Args({20, 20, 1})
    ->Args({20, 20, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(Factorize, Edges, false)
    ->Args({20, 20, 1})
    ->Args({141, 141, 1})
    ->Args({141, 141, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(Solve, Points, true)->Args({20, 20})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Solve, Edges, false)
    ->Args({20, 20})
    ->Args({141, 141})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace ceres_ed
