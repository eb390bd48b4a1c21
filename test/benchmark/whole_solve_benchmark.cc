// Level I of a window of 20 x 20 nodes, 300 of them PR, and a camera: the block solver, Ceres on
// the same cost functions, and Ceres as its manual would have a new user do it ("Plain": auto-diff
// by all 48 + 7 parameters that a point depends on, SPARSE_NORMAL_CHOLESKY, all options at their
// defaults). All three have the BLAS of this library's build: OpenBLAS, where Ceres by itself takes
// what the system has installed, which may be ATLAS or the reference BLAS, and slower.
//
// OneIteration has everything that a frame pays for a step: building, linearising, factorising.
// WholeSolve goes from rest to convergence. Counters: accepted steps (Ceres takes back the last
// one, which shows that nothing is to be gained), cost, milliseconds without building, and by how
// much the cost differs from that of the block solver, relative to it.
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/testing/residual_collection.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>
#include <ceres/autodiff_cost_function.h>
#include <ceres/solver.h>
#include <cost_functions/point_to_plane_cost.h>
#include <cost_functions/pose_prior_cost.h>
#include <cost_functions/regularization_cost.h>
#include <cost_functions/rotation_cost.h>
#include <cost_functions/warped_point_cost.h>
#include <glog/logging.h>
#include <test/problem/strip_builder.h>

namespace ceres_ed {
namespace {

constexpr int kSide = 20;
constexpr int kObservedColumns = 14;
constexpr int kPointRelevantNodes = (kObservedColumns + 1) * kSide;
// Well below the difference that is allowed, so that both are at the minimum.
constexpr double kFunctionTolerance = 1e-8;
constexpr double kLargestDifference = 1e-6;

// Without a prior camera and window could move together.
constexpr double kPosePriorWeight = 1.0;
constexpr double kRotationSigmaDeg = 1.0;
constexpr double kTranslationSigma = 0.01;

// How far the far end of what is seen has risen, node spacings.
constexpr double kLift = 2.0;

class Window {
 public:
  explicit Window(int num_points) : strip_(Options(num_points), "point_to_plane") {
    BendTargets();
    strip_.Add("pose_prior",
               kPosePriorWeight,
               {},
               {{"rotation_sigma", kRotationSigmaDeg}, {"translation_sigma", kTranslationSigma}});
    const std::vector<char> relevant = strip_.builder.PointRelevantNodes();
    CHECK_EQ(std::count(relevant.begin(), relevant.end(), 1), kPointRelevantNodes);
    // Every node of the window is within so many rings.
    config_ = LevelOneConfig(problem().graph, relevant, true, BoundaryEdges::kKeep, kSide);
    CHECK_EQ(config_.NumVariableNodes(), kSide * kSide);
  }

  const TestProblem& problem() const { return strip_.problem; }
  const ProblemBuilder& builder() const { return strip_.builder; }
  const ProblemConfig& config() const { return config_; }
  double rotation_weight() const { return builder().weight(strip_.rotation); }
  double regularization_weight() const { return builder().weight(strip_.regularization); }
  double data_weight() const { return builder().weight(strip_.data); }

 private:
  static TestProblemOptions Options(int num_points) {
    TestProblemOptions options;
    options.columns = kSide;
    options.rows = kSide;
    options.observed_columns = kObservedColumns;
    options.points_per_cell = num_points / (kObservedColumns * (kSide - 1));
    options.has_camera = true;
    options.target_deviation = 0.05;
    return options;
  }

  void BendTargets() {
    for (Correspondence& match : strip_.problem.correspondences) {
      const double x = match.target.x() / kObservedColumns;
      match.target.z() += kLift * x * x;
    }
    strip_.builder.CollectResiduals(
        strip_.data, **strip_.registry.Create("point_to_plane", {}), strip_.problem.Context());
  }

  StripBuilder strip_;
  ProblemConfig config_;
};

// Solves `window` from rest with the library.
LevelSummary SolveByLibrary(LinearSolver linear_solver, const Window& window, int max_iterations) {
  SolverOptions options;
  options.max_iterations = max_iterations;
  options.function_tolerance = kFunctionTolerance;
  DeformationState state(window.problem().graph.num_nodes());
  SolveSummary summary;
  CHECK(MakeLevelSolver(linear_solver)
            ->Solve(window.builder(), window.config(), options, &state, &summary));
  return summary.levels.front();
}

ceres::LossFunction* Weight(double weight) {
  return new ceres::ScaledLoss(nullptr, weight, ceres::TAKE_OWNERSHIP);
}

void AddPriors(const Window& window, DeformationState* state, ceres::Problem* problem) {
  const DeformationGraph& graph = window.problem().graph;
  ceres::LossFunction* const rotation_weight = Weight(window.rotation_weight());
  for (int j = 0; j < graph.num_nodes(); ++j) {
    problem->AddResidualBlock(RotationCost::Create(), rotation_weight, state->node(j));
  }
  using AutoDiffRegularization =
      ceres::AutoDiffCostFunction<RegularizationCost, 3, kNodeSize, kNodeSize>;
  ceres::LossFunction* const regularization_weight = Weight(window.regularization_weight());
  for (const GraphEdge& edge : graph.edges()) {
    problem->AddResidualBlock(new AutoDiffRegularization(new RegularizationCost(
                                  graph.position(edge.from), graph.position(edge.to), edge.weight)),
                              regularization_weight,
                              state->node(edge.from),
                              state->node(edge.to));
  }
}

void AddPoints(const Window& window, DeformationState* state, ceres::Problem* problem) {
  const TestProblem& test = window.problem();
  ceres::LossFunction* const weight = Weight(window.data_weight());
  double* const rotation = state->camera_from_map.rotation.coeffs().data();
  double* const translation = state->camera_from_map.translation.data();
  for (const Correspondence& match : test.correspondences) {
    const Binding binding = test.skinning[match.point];
    const BoundPoint point(
        test.points[match.point], binding.size, binding.weights, [&](int i) -> Eigen::Vector3d {
          return test.graph.position(binding.nodes[i]);
        });
    const auto node = [&](int i) { return state->node(binding.nodes[i]); };
    problem->AddResidualBlock(
        CreateAutoDiffWarpedPointCost<4>(PointToPlaneCost(match.target, match.normal), point, true),
        weight,
        node(0),
        node(1),
        node(2),
        node(3),
        rotation,
        translation);
  }
}

void AddCamera(DeformationState* state, ceres::Problem* problem) {
  double* const rotation = state->camera_from_map.rotation.coeffs().data();
  Eigen::Matrix<double, 6, 6> sqrt_information = Eigen::Matrix<double, 6, 6>::Zero();
  sqrt_information.diagonal() << Eigen::Vector3d::Constant(180.0 / M_PI / kRotationSigmaDeg),
      Eigen::Vector3d::Constant(1.0 / kTranslationSigma);
  problem->AddResidualBlock(
      PosePriorCost::Create(
          Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero(), sqrt_information),
      Weight(kPosePriorWeight),
      rotation,
      state->camera_from_map.translation.data());
  problem->SetManifold(rotation, new ceres::EigenQuaternionManifold);
}

// Solves `window` from rest with Ceres alone, to the same tolerances.
LevelSummary SolvePlain(const Window& window, int max_iterations) {
  DeformationState state(window.problem().graph.num_nodes());
  Timer timer;
  ceres::Problem problem;
  AddPriors(window, &state, &problem);
  AddPoints(window, &state, &problem);
  AddCamera(&state, &problem);
  LevelSummary level;
  level.build_time_s = timer.Seconds();
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = max_iterations;
  options.function_tolerance = kFunctionTolerance;
  options.gradient_tolerance = SolverOptions().gradient_tolerance;
  options.parameter_tolerance = SolverOptions().parameter_tolerance;
  ceres::Solver::Summary summary;
  timer.Restart();
  ceres::Solve(options, &problem, &summary);
  level.solve_time_s = timer.Seconds();
  CHECK(summary.IsSolutionUsable()) << summary.message;
  level.iterations = static_cast<int>(summary.iterations.size()) - 1;
  level.final_cost = summary.final_cost;
  return level;
}

using Solve = std::function<LevelSummary(const Window&, int max_iterations)>;

const Solve kBlock = [](const Window& window, int max_iterations) {
  return SolveByLibrary(LinearSolver::kBlock, window, max_iterations);
};
const Solve kCeres = [](const Window& window, int max_iterations) {
  return SolveByLibrary(LinearSolver::kCeres, window, max_iterations);
};
const Solve kPlain = SolvePlain;

void Run(benchmark::State& state, const Solve& solve, int max_iterations) {
  const Window window(state.range(0));
  LevelSummary level;
  double solve_time_s = 0.0;
  for (auto _ : state) {
    level = solve(window, max_iterations);
    solve_time_s += level.solve_time_s;
  }
  const double block_cost = kBlock(window, max_iterations).final_cost;
  const double difference = std::abs(level.final_cost - block_cost) / block_cost;
  CHECK_LT(difference, kLargestDifference);
  state.counters["points"] = window.problem().correspondences.size();
  state.counters["steps"] = level.iterations;
  state.counters["solve_ms"] = 1e3 * solve_time_s / state.iterations();
  state.counters["cost"] = level.final_cost;
  state.counters["difference"] = difference;
}

void OneIteration(benchmark::State& state, const Solve& solve) { Run(state, solve, 1); }

void WholeSolve(benchmark::State& state, const Solve& solve) {
  Run(state, solve, SolverOptions().max_iterations);
}

void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(77000)->Arg(10000)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(OneIteration, Block, kBlock)->Apply(Sizes);
BENCHMARK_CAPTURE(OneIteration, Ceres, kCeres)->Apply(Sizes);
BENCHMARK_CAPTURE(OneIteration, Plain, kPlain)->Apply(Sizes);
BENCHMARK_CAPTURE(WholeSolve, Block, kBlock)->Apply(Sizes);
BENCHMARK_CAPTURE(WholeSolve, Plain, kPlain)->Apply(Sizes);

}  // namespace
}  // namespace ceres_ed
