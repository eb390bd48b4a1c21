// One solve in which PI nodes are marginalised.
#ifndef CERES_ED_SOLVER_MARGINAL_MARGINAL_SOLVE_H_
#define CERES_ED_SOLVER_MARGINAL_MARGINAL_SOLVE_H_

#include <ceres_ed/problem/problem_builder.h>
#include <ceres_ed/solver/level_solver.h>
#include <ceres_ed/solver/marginal/marginalization.h>
#include <ceres_ed/solver/solver_types.h>
#include <ceres_ed/solver/trust_region.h>
#include <ceres_ed/util/timer.h>

#include <string>

namespace ceres_ed {

// The problem of a MarginalSolve, and its limits.
struct MarginalProblem {
  const ProblemBuilder* builder = nullptr;
  // The variable nodes (camera and PR nodes), with the other nodes eliminated.
  ProblemConfig level_one;
  const SolverOptions* options = nullptr;
  // StrategyOptions::relinearize_above.
  double relinearize_above = 0.0;
  // A timer that was started with the solve.
  const Timer* timer = nullptr;
};

// The iterations of a ConfigSolver: the Levenberg-Marquardt method on the full energy. Each step is
// a step of Level I, followed by the back-substitution of the eliminated nodes.
class MarginalSolve {
 public:
  // The problem of `marginalization` must be set. All arguments must outlive this object.
  MarginalSolve(const MarginalProblem& problem,
                LevelSolver* level_one_solver,
                Marginalization* marginalization,
                DeformationState* state);

  // Moves the state, and fills in status and message. If it fails, the state may have moved.
  void Iterate(SolveSummary* summary);

  // Return the summaries of the camera and PR nodes, and of the eliminated nodes with the cost of
  // their residuals.
  const LevelSummary& level_one() const { return level_one_; }
  const LevelSummary& level_two() const { return level_two_; }
  // Returns false if not even a first step was tried; the energies are then unknown.
  bool energy_known() const { return energy_known_; }
  double initial_energy() const { return initial_energy_; }
  double energy() const { return energy_; }

 private:
  enum class Step { kAccepted, kRejected, kInvalid, kConverged, kFailed };

  bool IsDone(SolveSummary* summary) const;
  bool Eliminate();
  bool Prepare(std::string* error);
  bool SolveLevelOne(DeformationState* candidate, SolveSummary* summary);
  void TakeOver(const LevelSummary& level);
  Step TakeStep(SolveSummary* summary);
  Step Judge(double rest, double prior, double eliminated, DeformationState* candidate);
  void Refuse();
  // Returns whether Level I made no step, although it had not converged.
  bool LevelOneWasRefused() const { return !level_one_moved_ && !level_one_converged_; }

  const MarginalProblem& problem_;
  const SolverOptions& options_;
  // The config of the problem, with the prior as an additional residual.
  ProblemConfig config_;
  LevelSolver* level_one_solver_;
  Marginalization* marginalization_;
  DeformationState* state_;
  LevelSummary level_one_;
  LevelSummary level_two_;
  // The trust region of Level I.
  TrustRegion region_;
  // The damping of the eliminated nodes.
  const double least_damping_;
  double damping_;
  // Whether the linearisation is at the present state.
  bool is_prepared_ = false;
  bool energy_known_ = false;
  double initial_energy_ = 0.0;
  double energy_ = 0.0;
  int level_one_steps_ = 1;
  // The outcome of the last step of Level I.
  bool level_one_moved_ = false;
  bool level_one_converged_ = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_MARGINAL_MARGINAL_SOLVE_H_
