// Options and outcomes of a solve.
#ifndef CERES_ED_SOLVER_SOLVER_TYPES_H_
#define CERES_ED_SOLVER_SOLVER_TYPES_H_

#include <ceres_ed/problem/problem_types.h>
#include <ceres_ed/util/named_values.h>
#include <ceres_ed/util/options_fwd.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace ceres_ed {

// What minimises a level.
enum class LinearSolver {
  // ceres::Solve: the reference.
  kCeres,
  // Block normal equations with a kept symbolic factor (block_level_solver.h): the same minimum in
  // less time.
  kBlock,
};

constexpr std::array<NamedValue<LinearSolver>, 2> NamesOf(LinearSolver) {
  return {{{"ceres", LinearSolver::kCeres}, {"block", LinearSolver::kBlock}}};
}

// Limits and tolerances of one solve; the defaults converge a problem in normalised units.
struct SolverOptions {
  // Of each level, >= 0.
  int max_iterations = 50;
  // Relative change of the cost at which a level is converged, >= 0.
  double function_tolerance = 1e-6;
  // Largest gradient entry at which a level is converged, >= 0.
  double gradient_tolerance = 1e-10;
  // Relative size of a step at which a level is converged, >= 0.
  double parameter_tolerance = 1e-8;
  // Levenberg-Marquardt damping is 1 / radius at the start, > 0. Large: nearly Gauss-Newton.
  double initial_trust_region_radius = 1e4;
  // Threads of residual and Jacobian evaluation, >= 1. The result doesn't depend on it: that of
  // kBlock to the bit, that of kCeres, which sums up the cost by thread, to rounding.
  int num_threads = 1;
  // Wall time of the whole solve, seconds, > 0. The step under way is finished, and a two-level
  // solve then lets PI nodes follow by up to three steps.
  double time_limit_s = 1e9;
  // Asked after every iteration; true ends the solve with the best state so far, in the same way.
  std::function<bool()> should_stop;

  // False, with the option and what was expected in `error`, when a value is out of range.
  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<SolverOptions>& Rows();
};

enum class SolveStatus { kFailed, kMaxIterations, kTimeLimit, kInterrupted, kConverged };

constexpr std::array<NamedValue<SolveStatus>, 5> NamesOf(SolveStatus) {
  return {{{"failed", SolveStatus::kFailed},
           {"max_iterations", SolveStatus::kMaxIterations},
           {"time_limit", SolveStatus::kTimeLimit},
           {"interrupted", SolveStatus::kInterrupted},
           {"converged", SolveStatus::kConverged}}};
}

// What one level did.
struct LevelSummary {
  int num_variable_nodes = 0;
  int iterations = 0;
  double initial_cost = 0.0;
  double final_cost = 0.0;
  double build_time_s = 0.0;
  double solve_time_s = 0.0;
};

// The outcome of a solve. It starts out failed.
struct SolveSummary {
  SolveStatus status = SolveStatus::kFailed;
  std::string message = "not solved";
  // The residual that made it fail (ProblemBuilder::CheckResiduals); empty where it was none.
  std::string fault;
  // Of the full problem (all residuals), before and after.
  double initial_energy = 0.0;
  double final_energy = 0.0;
  // In the order in which they were solved: one of batch, or Level I and Level II.
  std::vector<LevelSummary> levels;

  // False when the state is what it was before the solve.
  bool IsUsable() const { return status != SolveStatus::kFailed; }
  int TotalIterations() const;
};

enum class SolveMode {
  // Every node at once.
  kBatch,
  // Camera and PR nodes (Eq. 14), then PI nodes (Eq. 15).
  kTwoLevel,
  // Camera and PR nodes with the PI nodes eliminated (Eq. 20), then PI nodes by back-substitution:
  // the minimum of kBatch. Its levels are Level I and the residuals of the eliminated nodes.
  kMarginal,
};

constexpr std::array<NamedValue<SolveMode>, 3> NamesOf(SolveMode) {
  return {{{"batch", SolveMode::kBatch},
           {"two_level", SolveMode::kTwoLevel},
           {"marginal", SolveMode::kMarginal}}};
}

// Which strategy, and how it treats the seam.
struct StrategyOptions {
  SolveMode mode = SolveMode::kBatch;
  // Rings of PI nodes that Level I moves too, >= 0.
  int rings = 2;
  // Of kTwoLevel.
  SeamEdges seam_edges = SeamEdges::kKeep;
  LinearSolver linear_solver = LinearSolver::kBlock;
  // kMarginal: change of an entry of A_j of a PI node above which an elimination isn't used again,
  // no unit, >= 0. It changes the number of steps and what one costs, not the minimum. Much above
  // the default the soft modes of a large hidden part go astray, and steps are refused.
  double relinearize_above = 0.003;
  // kMarginal: rings beyond those that are eliminated, >= 1; the nodes behind them are held. -1:
  // all that are left are eliminated.
  int marginal_reach = -1;

  bool IsValid(std::string* error) const;
  // The options as data: name, range and text of each.
  static const OptionTable<StrategyOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_SOLVER_TYPES_H_
