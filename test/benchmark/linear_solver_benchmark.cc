// Whole solves of large graphs with the factor ("Block") and with conjugate gradients, by their
// preconditioner: a sheet, and a closed body (a torus), each bent and pressed in at some places. A
// node has four neighbours along the surface, and there is one point in each cell of four nodes.
// Half of the cells are seen, as by a camera; the rest follows by regularisation alone.
//
// Counters: Levenberg-Marquardt steps, the cost at the end, seconds of building and of solving, and
// the peak memory of the process, which has a meaning only if one benchmark is run alone.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/testing/test_problem.h>

#include <array>
#include <cmath>

#include <benchmark/benchmark.h>
#include <glog/logging.h>
#include <sys/resource.h>

namespace ceres_ed {
namespace {

constexpr double kRegularization = 10.0;
constexpr double kData = 0.1;

// Where a node or a point of the surface lies; `u` and `v` count node spacings.
using Surface = Eigen::Vector3d (*)(double u, double v, int side);

Eigen::Vector3d Sheet(double u, double v, int /*side*/) {
  return {u, v, 2.0 * std::sin(0.1 * u) * std::cos(0.08 * v)};
}

// A torus with as many nodes around its tube as along it.
Eigen::Vector3d Torus(double u, double v, int side) {
  const double a = 2.0 * M_PI * u / side;
  const double b = 2.0 * M_PI * v / side;
  const double tube = side / (2.0 * M_PI);
  const double ring = 3.0 * tube + tube * std::cos(b);
  return {ring * std::cos(a), ring * std::sin(a), tube * std::sin(b)};
}

struct Body {
  Surface surface;
  bool closed;
};
constexpr Body kSheet{Sheet, false};
constexpr Body kTorus{Torus, true};

// The target of a point: bumps that are about ten nodes wide, and a slow bend of the whole.
Eigen::Vector3d Target(const Eigen::Vector3d& p, int side) {
  const double bump = std::sin(0.35 * p.x()) * std::sin(0.3 * p.y());
  const double bend = std::sin(3.0 * p.x() / side);
  return p + Eigen::Vector3d(0.3 * bump, 0.05 * side * bend * bend, bump);
}

TestProblem MakeBody(const Body& body, int side) {
  TestProblem problem;
  problem.has_camera = false;
  for (int u = 0; u < side; ++u) {
    for (int v = 0; v < side; ++v) problem.graph.AddNode(body.surface(u, v, side));
  }
  const auto node = [side](int u, int v) { return (u % side) * side + v % side; };
  const auto join = [&](int a, int b) {
    problem.graph.AddEdge({a, b, 1.0});
    problem.graph.AddEdge({b, a, 1.0});
  };
  const int cells = body.closed ? side : side - 1;
  for (int u = 0; u < side; ++u) {
    for (int v = 0; v < side; ++v) {
      if (u < cells) join(node(u, v), node(u + 1, v));
      if (v < cells) join(node(u, v), node(u, v + 1));
    }
  }
  for (int u = 0; u < cells; ++u) {
    for (int v = 0; v < cells; ++v) {
      const std::array<int, 4> nodes{
          node(u, v), node(u + 1, v), node(u, v + 1), node(u + 1, v + 1)};
      const std::array<double, 4> weights{0.28, 0.22, 0.27, 0.23};
      problem.skinning.Add(nodes.data(), weights.data(), 4);
      problem.points.push_back(body.surface(u + 0.45, v + 0.5, side));
      if (2 * u > side) continue;
      Correspondence match;
      match.point = static_cast<int>(problem.points.size()) - 1;
      match.target = Target(problem.points.back(), side);
      match.normal = Eigen::Vector3d::UnitZ();
      problem.correspondences.push_back(match);
    }
  }
  return problem;
}

double PeakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-3 * static_cast<double>(usage.ru_maxrss);
}

void Solve(benchmark::State& state,
           const Body& body,
           LinearSolver linear_solver,
           PreconditionerKind preconditioner) {
  const auto side = static_cast<int>(std::lround(std::sqrt(state.range(0))));
  const TestProblem problem = MakeBody(body, side);
  const EnergyRegistry registry = BuiltinEnergies();
  ProblemBuilder builder(problem.graph, false);
  const auto add = [&](const char* name, double weight) {
    const auto term = registry.Create(name, {});
    CHECK(term.ok());
    const int index = builder.AddTerm(name, (*term)->kind(), weight, {});
    builder.CollectResiduals(index, **term, problem.Context());
  };
  add("rotation", 1.0);
  add("regularization", kRegularization);
  add("point_to_point", kData);
  const double problem_mb = PeakMegabytes();
  ProblemConfig config;
  config.variable_nodes.assign(problem.graph.num_nodes(), 1);
  SolverOptions options;
  options.num_threads = static_cast<int>(state.range(1));
  LevelSummary level;
  for (auto _ : state) {
    DeformationState solution(problem.graph.num_nodes());
    SolveSummary summary;
    CHECK(MakeLevelSolver(linear_solver, preconditioner)
              ->Solve(builder, config, options, &solution, &summary))
        << summary.message;
    level = summary.levels.front();
  }
  state.counters["nodes"] = problem.graph.num_nodes();
  state.counters["steps"] = level.iterations;
  state.counters["cost"] = level.final_cost;
  state.counters["build_s"] = level.build_time_s;
  state.counters["solve_s"] = level.solve_time_s;
  state.counters["problem_MB"] = problem_mb;
  state.counters["peak_MB"] = PeakMegabytes();
}

void Sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int threads : {1, 2}) {
    for (const int nodes : {1000, 5000, 20000, 50000, 200000, 1000000}) {
      benchmark->Args({nodes, threads});
    }
  }
  benchmark->Unit(benchmark::kMillisecond)->Iterations(1)->UseRealTime();
}

constexpr auto kTwoLevel = PreconditionerKind::kTwoLevel;
constexpr auto kBlockJacobi = PreconditionerKind::kBlockJacobi;
constexpr auto kIncomplete = PreconditionerKind::kIncompleteCholesky;

BENCHMARK_CAPTURE(Solve, SheetBlock, kSheet, LinearSolver::kBlock, kTwoLevel)->Apply(Sizes);
BENCHMARK_CAPTURE(Solve, SheetTwoLevel, kSheet, LinearSolver::kPcg, kTwoLevel)->Apply(Sizes);
BENCHMARK_CAPTURE(Solve, SheetJacobi, kSheet, LinearSolver::kPcg, kBlockJacobi)->Apply(Sizes);
BENCHMARK_CAPTURE(Solve, SheetIncomplete, kSheet, LinearSolver::kPcg, kIncomplete)->Apply(Sizes);
BENCHMARK_CAPTURE(Solve, SheetCgnr, kSheet, LinearSolver::kCeresCgnr, kTwoLevel)->Apply(Sizes);
BENCHMARK_CAPTURE(Solve, TorusBlock, kTorus, LinearSolver::kBlock, kTwoLevel)->Apply(Sizes);
BENCHMARK_CAPTURE(Solve, TorusTwoLevel, kTorus, LinearSolver::kPcg, kTwoLevel)->Apply(Sizes);
BENCHMARK_CAPTURE(Solve, TorusJacobi, kTorus, LinearSolver::kPcg, kBlockJacobi)->Apply(Sizes);

}  // namespace
}  // namespace ceres_ed
