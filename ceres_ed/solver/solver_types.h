// Options and outcomes of a solve.
#ifndef CERES_ED_SOLVER_SOLVER_TYPES_H_
#define CERES_ED_SOLVER_SOLVER_TYPES_H_

#include <ceres_ed/problem/problem_types.h>
#include <ceres_ed/util/named_values.h>

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace ceres_ed {

// The minimiser of a level.
enum class LinearSolver {
  // ceres::Solve, which is the reference.
  kCeres,
  // Block normal equations whose symbolic factor is kept (block_level_solver.h): the same minimum
  // in less time.
  kBlock,
  // The same normal equations, solved by preconditioned conjugate gradients, without a factor: less
  // memory, and less time for large graphs.
  kPcg,
  // kBlock or kPcg, by the number of variable nodes.
  kAuto,
  // ceres::Solve with CGNR, the conjugate gradients of Ceres.
  kCeresCgnr,
};

constexpr std::array<NamedValue<LinearSolver>, 5> NamesOf(LinearSolver) {
  return {{{"ceres", LinearSolver::kCeres},
           {"block", LinearSolver::kBlock},
           {"pcg", LinearSolver::kPcg},
           {"auto", LinearSolver::kAuto},
           {"ceres_cgnr", LinearSolver::kCeresCgnr}}};
}

// What makes the conjugate gradients of kPcg converge.
enum class PreconditionerKind {
  // Smooth motions are solved for on a coarse graph, the rest node by node.
  kTwoLevel,
  // The 12 x 12 blocks of the nodes, and the camera with its border.
  kBlockJacobi,
  // An incomplete factor without fill.
  kIncompleteCholesky,
};

constexpr std::array<NamedValue<PreconditionerKind>, 3> NamesOf(PreconditionerKind) {
  return {{{"two_level", PreconditionerKind::kTwoLevel},
           {"block_jacobi", PreconditionerKind::kBlockJacobi},
           {"incomplete_cholesky", PreconditionerKind::kIncompleteCholesky}}};
}

// Limits and tolerances of one solve. With the defaults a problem in normalised units converges.
struct SolverOptions {
  // The largest number of iterations of each level, >= 0; default 50.
  int max_iterations = 50;
  // A level has converged if the relative change of the cost is less than this; >= 0, default 1e-6.
  double function_tolerance = 1e-6;
  // A level has converged if no entry of the gradient is larger than this; >= 0, default 1e-10.
  double gradient_tolerance = 1e-10;
  // A level has converged if the relative size of a step is less than this; >= 0, default 1e-8.
  double parameter_tolerance = 1e-8;
  // The initial damping of the Levenberg-Marquardt method is 1 / radius; > 0, default 1e4. With a
  // large radius the steps are nearly Gauss-Newton steps.
  double initial_trust_region_radius = 1e4;
  // The number of threads that evaluate residuals and Jacobians, >= 1, default 1. The result does
  // not depend on it: with kBlock it has the same bits; with kCeres, which sums the cost per
  // thread, it is the same up to rounding.
  int num_threads = 1;
  // The wall time of the whole solve in seconds, > 0; default 1e9. The current step is completed,
  // and in a two-level solve the PI nodes then follow by up to three steps.
  double time_limit_s = 1e9;
  // Called after every iteration; if it returns true, the solve ends with the best state so far, in
  // the same way.
  std::function<bool()> should_stop;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<SolverOptions>& Rows();
};

// How a solve ended.
enum class SolveStatus { kFailed, kMaxIterations, kTimeLimit, kInterrupted, kConverged };

// Returns the names of the values; they are part of the files that programs write.
constexpr std::array<NamedValue<SolveStatus>, 5> NamesOf(SolveStatus) {
  return {{{"failed", SolveStatus::kFailed},
           {"max_iterations", SolveStatus::kMaxIterations},
           {"time_limit", SolveStatus::kTimeLimit},
           {"interrupted", SolveStatus::kInterrupted},
           {"converged", SolveStatus::kConverged}}};
}

// What one level did. Times are in seconds.
struct LevelSummary {
  int num_variable_nodes = 0;
  int iterations = 0;
  double initial_cost = 0.0;
  double final_cost = 0.0;
  double build_time_s = 0.0;
  double solve_time_s = 0.0;
};

// The PI nodes that a Level I of kTwoLevel has moved, and what it costs to hold the others.
struct ActiveSetSummary {
  // In ascending order.
  std::vector<int> hidden_nodes;
  // With kInformation: the energy that the held nodes would lose at once if they were released, as
  // a share of the energy of Level I (decoupling/active_set.h); NaN if it is not known.
  double held_share = std::numeric_limits<double>::quiet_NaN();
};

// The result of a solve. Its initial status is failed.
struct SolveSummary {
  SolveStatus status = SolveStatus::kFailed;
  std::string message = "not solved";
  // The residual that made the solve fail (ProblemBuilder::CheckResiduals()); empty if none did.
  std::string fault;
  // The energy of the full problem (all residuals) before and after the solve.
  double initial_energy = 0.0;
  double final_energy = 0.0;
  // The levels in the order in which they were solved: one level for batch, or Level I and Level
  // II.
  std::vector<LevelSummary> levels;
  ActiveSetSummary active_set;

  // Returns false if the solve failed; the state is then unchanged.
  bool IsUsable() const { return status != SolveStatus::kFailed; }
  // Returns the sum of the iterations of all levels.
  int TotalIterations() const;
};

// Which nodes are moved together.
enum class SolveMode {
  // All nodes.
  kBatch,
  // The camera and the PR nodes (Eq. 14), then the PI nodes (Eq. 15).
  kTwoLevel,
  // The camera and the PR nodes with the PI nodes eliminated (Eq. 20), then the PI nodes by
  // back-substitution (Eq. 21). The minimum is that of kBatch. Its two levels are Level I and the
  // residuals of the eliminated nodes.
  kMarginal,
};

constexpr std::array<NamedValue<SolveMode>, 3> NamesOf(SolveMode) {
  return {{{"batch", SolveMode::kBatch},
           {"two_level", SolveMode::kTwoLevel},
           {"marginal", SolveMode::kMarginal}}};
}

// Which PI nodes Level I of kTwoLevel moves.
enum class ActiveSetRule {
  // Those within StrategyOptions::rings of a PR node.
  kRings,
  // Those that would lose the most energy by being held (decoupling/active_set.h).
  kInformation,
};

constexpr std::array<NamedValue<ActiveSetRule>, 2> NamesOf(ActiveSetRule) {
  return {{{"rings", ActiveSetRule::kRings}, {"information", ActiveSetRule::kInformation}}};
}

// The strategy of a solve, and its treatment of the boundary.
struct StrategyOptions {
  SolveMode mode = SolveMode::kBatch;
  // The number of rings of PI nodes that Level I moves as well; >= 0, default 2.
  int rings = 2;
  // For kTwoLevel: how the PI nodes that Level I moves are chosen; default kRings.
  ActiveSetRule active = ActiveSetRule::kRings;
  // For kInformation: the energy that the held nodes may lose, as a share of the energy of Level I;
  // without unit, >= 0, default 1e-4. With 0 every PI node becomes active that feels a force.
  double active_bound = 1e-4;
  // For kTwoLevel: whether the edges of the boundary are kept or cut; default kKeep.
  BoundaryEdges boundary_edges = BoundaryEdges::kKeep;
  LinearSolver linear_solver = LinearSolver::kBlock;
  // For kPcg.
  PreconditionerKind preconditioner = PreconditionerKind::kTwoLevel;
  // For kMarginal: if an entry of A_j of a PI node changes by more than this, an elimination is not
  // used again; without unit, >= 0, default 0.003. The value affects the number and the cost of the
  // steps, not the minimum. With values much above the default, the soft modes of a large hidden
  // part become wrong, and steps are refused.
  double relinearize_above = 0.003;
  // For kMarginal: the number of rings of nodes around Level I that are eliminated, >= 1; the nodes
  // beyond them are held. With -1, the default, all remaining nodes are eliminated.
  int marginal_reach = -1;

  // Returns false, with the option and what was expected in `error`, if a value is out of range.
  bool IsValid(std::string* error) const;
  // Returns the options as data: the name, range and text of each.
  static const OptionTable<StrategyOptions>& Rows();
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_SOLVER_TYPES_H_
