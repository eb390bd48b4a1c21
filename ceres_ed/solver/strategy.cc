#include "ceres_ed/solver/strategy.h"

#include <ceres_ed/solver/block_level_solver.h>
#include <ceres_ed/solver/ceres_level_solver.h>
#include <ceres_ed/solver/strategies/marginal_strategy.h>
#include <ceres_ed/util/option_check.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <limits>

namespace ceres_ed {
namespace {

// Every residual and every node at once: the reference for the others.
class BatchStrategy final : public Strategy {
 public:
  explicit BatchStrategy(LinearSolver linear_solver) : solver_(MakeLevelSolver(linear_solver)) {}

  SolveSummary Solve(const ProblemBuilder& builder,
                     const SolverOptions& options,
                     DeformationState* state) override {
    SolveSummary summary;
    const ProblemConfig full = FullConfig(builder.graph().num_nodes(), builder.has_camera());
    if (solver_->Solve(builder, full, options, state, &summary) &&
        summary.levels.back().num_variable_nodes > 0) {
      // Every residual touches something variable: the level has them all.
      summary.initial_energy = summary.levels.back().initial_cost;
      summary.final_energy = summary.levels.back().final_cost;
    } else {
      summary.initial_energy = builder.Evaluate(*state).Total();
      summary.final_energy = summary.initial_energy;
    }
    return summary;
  }

 private:
  std::unique_ptr<LevelSolver> solver_;
};

// The two steps of the paper: camera and PR nodes (Eq. 14), then PI nodes (Eq. 15).
class TwoLevelStrategy final : public Strategy {
 public:
  explicit TwoLevelStrategy(const StrategyOptions& options)
      : rings_(options.rings),
        seam_edges_(options.seam_edges),
        level_one_(MakeLevelSolver(options.linear_solver)),
        level_two_(MakeLevelSolver(options.linear_solver)) {}

  SolveSummary Solve(const ProblemBuilder& builder,
                     const SolverOptions& options,
                     DeformationState* state) override {
    SolveSummary summary;
    summary.initial_energy = builder.Evaluate(*state).Total();
    summary.final_energy = summary.initial_energy;
    const Timer timer;
    const std::vector<char> point_relevant = builder.PointRelevantNodes();
    const ProblemConfig level_one =
        LevelOneConfig(builder.graph(), point_relevant, builder.has_camera(), seam_edges_, rings_);
    const DeformationState start = *state;
    if (!level_one_->Solve(builder, level_one, options, state, &summary)) return summary;

    const SolveStatus level_one_status = summary.status;
    const std::string level_one_message = summary.message;
    const SolverOptions level_two_options =
        LevelTwoOptions(options, summary, options.time_limit_s - timer.Seconds());
    if (!level_two_->Solve(
            builder, LevelTwoConfig(point_relevant), level_two_options, state, &summary)) {
      *state = start;
      return summary;
    }
    if (level_one_status != SolveStatus::kConverged) {
      summary.status = level_one_status;
      summary.message = level_one_message;
    }
    summary.final_energy = builder.Evaluate(*state).Total();
    return summary;
  }

 private:
  // Where Level I was stopped early, PI nodes still follow by a few steps, whatever time or caller
  // say: a torn seam would be no usable state.
  static SolverOptions LevelTwoOptions(const SolverOptions& options,
                                       const SolveSummary& level_one,
                                       double time_left_s) {
    constexpr int kFollowingSteps = 3;
    constexpr double kLeastTime = 1e-3;
    SolverOptions level_two = options;
    level_two.time_limit_s = std::max(kLeastTime, time_left_s);
    if (level_one.status == SolveStatus::kTimeLimit ||
        level_one.status == SolveStatus::kInterrupted) {
      const bool moved = level_one.levels.back().iterations > 0;
      level_two.max_iterations = moved ? std::min(kFollowingSteps, options.max_iterations) : 0;
      level_two.time_limit_s = std::numeric_limits<double>::max();
      level_two.should_stop = nullptr;
    }
    return level_two;
  }

  int rings_;
  SeamEdges seam_edges_;
  // Each keeps the structure of its own level.
  std::unique_ptr<LevelSolver> level_one_;
  std::unique_ptr<LevelSolver> level_two_;
};

}  // namespace

bool SolverOptions::IsValid(std::string* error) const {
  return RequireOption(max_iterations >= 0, "max_iterations", max_iterations, ">= 0", error) &&
         RequireOption(
             function_tolerance >= 0.0, "function_tolerance", function_tolerance, ">= 0", error) &&
         RequireOption(
             gradient_tolerance >= 0.0, "gradient_tolerance", gradient_tolerance, ">= 0", error) &&
         RequireOption(parameter_tolerance >= 0.0,
                       "parameter_tolerance",
                       parameter_tolerance,
                       ">= 0",
                       error) &&
         RequireOption(initial_trust_region_radius > 0.0,
                       "initial_trust_region_radius",
                       initial_trust_region_radius,
                       "> 0",
                       error) &&
         RequireOption(num_threads >= 1, "num_threads", num_threads, ">= 1", error) &&
         RequireOption(time_limit_s > 0.0, "time_limit_s", time_limit_s, "> 0 seconds", error);
}

bool StrategyOptions::IsValid(std::string* error) const {
  return RequireOption(rings >= 0, "rings", rings, ">= 0", error) &&
         RequireOption(
             relinearize_above >= 0.0, "relinearize_above", relinearize_above, ">= 0", error) &&
         RequireOption(marginal_reach == -1 || marginal_reach >= 1,
                       "marginal_reach",
                       marginal_reach,
                       "-1 or >= 1",
                       error);
}

std::string SolveStatusName(SolveStatus status) {
  switch (status) {
    case SolveStatus::kFailed:
      return "failed";
    case SolveStatus::kMaxIterations:
      return "max_iterations";
    case SolveStatus::kTimeLimit:
      return "time_limit";
    case SolveStatus::kInterrupted:
      return "interrupted";
    case SolveStatus::kConverged:
      return "converged";
  }
  return "failed";
}

int SolveSummary::TotalIterations() const {
  int total = 0;
  for (const LevelSummary& level : levels) total += level.iterations;
  return total;
}

std::unique_ptr<LevelSolver> MakeLevelSolver(LinearSolver linear_solver) {
  switch (linear_solver) {
    case LinearSolver::kCeres:
      return std::make_unique<CeresLevelSolver>();
    case LinearSolver::kBlock:
      return std::make_unique<BlockLevelSolver>();
  }
  LOG(FATAL) << "unknown linear solver";
}

void ExplainFailure(const ProblemBuilder& builder,
                    const DeformationState& state,
                    const std::string& otherwise,
                    SolveSummary* summary) {
  summary->status = SolveStatus::kFailed;
  summary->fault = builder.CheckResiduals(state).message();
  summary->message = summary->fault.empty() ? otherwise : summary->fault;
}

std::unique_ptr<Strategy> MakeStrategy(const StrategyOptions& options) {
  switch (options.mode) {
    case SolveMode::kBatch:
      return std::make_unique<BatchStrategy>(options.linear_solver);
    case SolveMode::kTwoLevel:
      return std::make_unique<TwoLevelStrategy>(options);
    case SolveMode::kMarginal:
      return std::make_unique<MarginalStrategy>(options);
  }
  LOG(FATAL) << "unknown mode";
}

}  // namespace ceres_ed
