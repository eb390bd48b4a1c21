#include "ceres_ed/solver/ceres_level_solver.h"

#include <ceres_ed/linear_algebra/linear_algebra_backend.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <thread>

#include <ceres/solver.h>

namespace ceres_ed {
namespace {

// Ends the solve when the caller requests it; Ceres then keeps the best state.
class StopCallback final : public ceres::IterationCallback {
 public:
  explicit StopCallback(const std::function<bool()>& should_stop) : should_stop_(should_stop) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    if (!should_stop_()) return ceres::SOLVER_CONTINUE;
    stopped_ = true;
    return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  bool stopped() const { return stopped_; }

 private:
  const std::function<bool()>& should_stop_;
  bool stopped_ = false;
};

// With CGNR, a step may end at this relative residual or after this many iterations.
constexpr double kCgnrTolerance = 1e-3;
constexpr int kCgnrIterations = 1000;

ceres::Solver::Options CeresOptions(const SolverOptions& options, bool iterative) {
  ceres::Solver::Options ceres_options;
  // This solver takes the same steps at any thread count, which the Schur solvers do not. Only the
  // last bits of the cost differ, because the cost is summed per thread.
  ceres_options.linear_solver_type = iterative ? ceres::CGNR : ceres::SPARSE_NORMAL_CHOLESKY;
  if (iterative) {
    ceres_options.preconditioner_type = ceres::JACOBI;
    ceres_options.eta = kCgnrTolerance;
    ceres_options.max_linear_solver_iterations = kCgnrIterations;
  }
  ceres_options.sparse_linear_algebra_library_type = PreferredSparseLibrary();
  ceres_options.max_num_iterations = options.max_iterations;
  ceres_options.function_tolerance = options.function_tolerance;
  ceres_options.gradient_tolerance = options.gradient_tolerance;
  ceres_options.parameter_tolerance = options.parameter_tolerance;
  ceres_options.initial_trust_region_radius = options.initial_trust_region_radius;
  // Ceres would complain on stderr, in each solve, about more threads than the machine has.
  const auto available = static_cast<int>(std::thread::hardware_concurrency());
  ceres_options.num_threads =
      available > 0 ? std::min(options.num_threads, available) : options.num_threads;
  ceres_options.max_solver_time_in_seconds = options.time_limit_s;
  ceres_options.logging_type = ceres::SILENT;
  return ceres_options;
}

SolveStatus StatusOf(const ceres::Solver::Summary& ceres_summary, const SolverOptions& options) {
  switch (ceres_summary.termination_type) {
    case ceres::CONVERGENCE:
    case ceres::USER_SUCCESS:
      return SolveStatus::kConverged;
    case ceres::NO_CONVERGENCE:
      return ceres_summary.total_time_in_seconds >= options.time_limit_s
                 ? SolveStatus::kTimeLimit
                 : SolveStatus::kMaxIterations;
    case ceres::FAILURE:
    case ceres::USER_FAILURE:
      return SolveStatus::kFailed;
  }
  return SolveStatus::kFailed;
}

}  // namespace

bool CeresLevelSolver::Solve(const ProblemBuilder& builder,
                             const ProblemConfig& config,
                             const SolverOptions& options,
                             DeformationState* state,
                             SolveSummary* summary) {
  LevelSummary level;
  if (!builder.status().ok()) {
    ExplainFailure(builder, *state, "", summary);
    summary->levels.push_back(level);
    return false;
  }
  Timer timer;
  const BuiltProblem built = builder.Build(config, state);
  level.build_time_s = timer.Seconds();
  level.num_variable_nodes = built.num_variable_nodes;
  if (built.num_variable_nodes == 0 && !built.camera_variable) {
    summary->status = SolveStatus::kConverged;
    summary->message = "nothing to move";
    summary->levels.push_back(level);
    return true;
  }

  ceres::Solver::Options ceres_options = CeresOptions(options, iterative_);
  StopCallback stop(options.should_stop);
  if (options.should_stop) ceres_options.callbacks.push_back(&stop);
  const ScopedSerialLinearAlgebra serial;
  ceres::Solver::Summary ceres_summary;
  timer.Restart();
  ceres::Solve(ceres_options, built.problem.get(), &ceres_summary);
  level.solve_time_s = timer.Seconds();
  // The first entry is the initial state, not a step.
  level.iterations = std::max(0, static_cast<int>(ceres_summary.iterations.size()) - 1);
  level.initial_cost = ceres_summary.initial_cost;
  level.final_cost = ceres_summary.final_cost;
  summary->levels.push_back(level);
  summary->status = stop.stopped() ? SolveStatus::kInterrupted : StatusOf(ceres_summary, options);
  summary->message = ceres_summary.message;
  if (!summary->IsUsable()) ExplainFailure(builder, *state, ceres_summary.message, summary);
  return summary->status != SolveStatus::kFailed;
}

}  // namespace ceres_ed
