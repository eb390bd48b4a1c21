// One solve for given point constraints: 1,500 points of a graph are to come to where a bend and a
// twist would have them, everything else follows. From rest to convergence, with the collection of
// residuals, on one thread. Sheets are about square, chains two nodes wide; nodes are joined to
// their 8 neighbours, both ways. Counters: steps taken, and the root mean square of what is left of
// the constraints, in node spacings.
#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/graph/warp.h>
#include <ceres_ed/solver/strategy.h>
#include <ceres_ed/testing/residual_collection.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <glog/logging.h>

namespace ceres_ed {
namespace {

constexpr int kNumConstraints = 1500;
// Weights of Sumner et al.
constexpr double kRotationWeight = 1.0;
constexpr double kRegularizationWeight = 10.0;
constexpr double kConstraintWeight = 100.0;
// Nearly Gauss-Newton: where the ends of a long chain move by thousands of node spacings, damping
// by 1e-4 of the diagonal, the default, bends the step so much that the first ones are refused.
constexpr double kTrustRegionRadius = 1e10;
// The bend of the whole sheet.
constexpr double kBend = 1.0;
constexpr double kTwist = 0.5;

struct ConstraintProblem {
  DeformationGraph graph;
  std::vector<Eigen::Vector3d> points;
  Skinning skinning;
  std::vector<Correspondence> constraints;
};

// Wraps x around a cylinder and turns the cross section with x.
Eigen::Vector3d Bend(const Eigen::Vector3d& p, double length, double width) {
  const double twist = kTwist * p.x() / length;
  const double y = p.y() - 0.5 * width;
  const Eigen::Vector3d turned(p.x(),
                               std::cos(twist) * y - std::sin(twist) * p.z(),
                               std::sin(twist) * y + std::cos(twist) * p.z());
  const double radius = length / kBend;
  const double angle = turned.x() / radius;
  return {(radius - turned.z()) * std::sin(angle),
          turned.y() + 0.5 * width,
          radius - (radius - turned.z()) * std::cos(angle)};
}

ConstraintProblem MakeProblem(int columns, int rows) {
  ConstraintProblem problem;
  const double length = columns - 1;
  const double width = rows - 1;
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) {
      problem.graph.AddNode({1.0 * c, 1.0 * r, 0.3 * std::sin(0.9 * c + 0.5 * r)});
    }
  }
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) {
      for (int dc = -1; dc <= 1; ++dc) {
        for (int dr = -1; dr <= 1; ++dr) {
          const bool is_inside = c + dc >= 0 && c + dc < columns && r + dr >= 0 && r + dr < rows;
          if ((dc == 0 && dr == 0) || !is_inside) continue;
          problem.graph.AddEdge({c * rows + r, (c + dc) * rows + r + dr, 1.0});
        }
      }
    }
  }
  const int num_cells = (columns - 1) * (rows - 1);
  for (int i = 0; i < kNumConstraints; ++i) {
    const int cell = static_cast<int>(static_cast<std::int64_t>(i) * num_cells / kNumConstraints);
    const double u = std::fmod(0.618 * i, 1.0);
    const double v = std::fmod(0.755 * i, 1.0);
    const int corner = cell / (rows - 1) * rows + cell % (rows - 1);
    const int nodes[] = {corner, corner + 1, corner + rows, corner + rows + 1};
    const double weights[] = {(1 - u) * (1 - v), (1 - u) * v, u * (1 - v), u * v};
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (int k = 0; k < 4; ++k) point += weights[k] * problem.graph.position(nodes[k]);
    problem.points.push_back(point);
    problem.skinning.Add(nodes, weights, 4);
    Correspondence constraint;
    constraint.point = i;
    constraint.target = Bend(point, length, width);
    problem.constraints.push_back(constraint);
  }
  return problem;
}

void PointConstraints(benchmark::State& state, LinearSolver linear_solver) {
  const ConstraintProblem problem = MakeProblem(state.range(0), state.range(1));
  const EnergyRegistry registry = BuiltinEnergies();
  EnergyContext context;
  context.graph = &problem.graph;
  context.points = &problem.points;
  context.skinning = &problem.skinning;
  context.correspondences = &problem.constraints;
  context.landmarks = &problem.constraints;
  StrategyOptions options;
  options.linear_solver = linear_solver;
  SolverOptions solver_options;
  solver_options.max_iterations = 200;
  solver_options.initial_trust_region_radius = kTrustRegionRadius;
  solver_options.num_threads = state.range(2);
  SolveSummary summary;
  DeformationState solution;
  for (auto _ : state) {
    ProblemBuilder builder(problem.graph, /*has_camera=*/false);
    for (const auto& [name, weight] : {std::pair("rotation", kRotationWeight),
                                       std::pair("regularization", kRegularizationWeight),
                                       std::pair("landmark", kConstraintWeight)}) {
      const auto term = registry.Create(name, {});
      CHECK(term.ok()) << term.status().message();
      const int index = builder.AddTerm(name, (*term)->kind(), weight);
      builder.CollectResiduals(index, **term, context);
    }
    solution = DeformationState(problem.graph.num_nodes());
    summary = MakeStrategy(options)->Solve(builder, solver_options, &solution);
  }
  CHECK(summary.status == SolveStatus::kConverged) << summary.message;
  std::vector<Eigen::Vector3d> warped;
  WarpPoints(problem.graph, solution, problem.skinning, problem.points, 1, &warped);
  double squared = 0.0;
  for (int i = 0; i < kNumConstraints; ++i) {
    squared += (warped[i] - problem.constraints[i].target).squaredNorm();
  }
  state.counters["nodes"] = problem.graph.num_nodes();
  state.counters["steps"] = summary.TotalIterations();
  state.counters["energy"] = summary.final_energy;
  state.counters["rms"] = std::sqrt(squared / kNumConstraints);
}

void Sheets(benchmark::internal::Benchmark* benchmark) {
  for (const auto& [columns, rows] :
       {std::pair(25, 20), std::pair(40, 25), std::pair(100, 50), std::pair(160, 125)}) {
    benchmark->Args({columns, rows, 1});
  }
}

void Chains(benchmark::internal::Benchmark* benchmark) {
  for (const int columns : {250, 500, 2500, 10000}) benchmark->Args({columns, 2, 1});
}

BENCHMARK_CAPTURE(PointConstraints, Sheet, LinearSolver::kBlock)
    ->Apply(Sheets)
    ->Args({160, 125, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(PointConstraints, Chain, LinearSolver::kBlock)
    ->Apply(Chains)
    ->Args({10000, 2, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(PointConstraints, SheetCeres, LinearSolver::kCeres)
    ->Args({25, 20, 1})
    ->Args({40, 25, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace ceres_ed
