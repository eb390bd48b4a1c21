// One solve with PI nodes marginalised.
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

// What MarginalSolve solves, and within what limits.
struct MarginalProblem {
  const ProblemBuilder* builder = nullptr;
  // Camera and PR nodes, with the others eliminated.
  ProblemConfig level_one;
  const SolverOptions* options = nullptr;
  // StrategyOptions::relinearize_above.
  double relinearize_above = 0.0;
  // Since the solve began.
  const Timer* timer = nullptr;
};

// The iterations of a ConfigSolver: Levenberg-Marquardt on the full energy, whose step is one of
// Level I with the eliminated nodes behind it.
class MarginalSolve {
 public:
  // `marginalization` has its problem set. Everything must outlive this.
  MarginalSolve(const MarginalProblem& problem,
                LevelSolver* level_one_solver,
                Marginalization* marginalization,
                DeformationState* state);

  // Moves the state and fills status and message. Where it fails the state may have moved.
  void Iterate(SolveSummary* summary);

  // Camera and PR nodes; and the eliminated ones, with the cost of their residuals.
  const LevelSummary& level_one() const { return level_one_; }
  const LevelSummary& level_two() const { return level_two_; }
  // False when not even a first step was tried; the energies are then not known.
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
  // The last step of Level I was none, and not for want of anything to gain.
  bool LevelOneWasRefused() const { return !level_one_moved_ && !level_one_converged_; }

  const MarginalProblem& problem_;
  const SolverOptions& options_;
  // The problem's, with the prior.
  ProblemConfig config_;
  LevelSolver* level_one_solver_;
  Marginalization* marginalization_;
  DeformationState* state_;
  LevelSummary level_one_;
  LevelSummary level_two_;
  // Of Level I.
  TrustRegion region_;
  // Of the eliminated nodes.
  const double least_damping_;
  double damping_;
  // Whether the linearisation is at the present state.
  bool is_prepared_ = false;
  bool energy_known_ = false;
  double initial_energy_ = 0.0;
  double energy_ = 0.0;
  int level_one_steps_ = 1;
  // Of the last step of Level I.
  bool level_one_moved_ = false;
  bool level_one_converged_ = false;
};

}  // namespace ceres_ed

#endif  // CERES_ED_SOLVER_MARGINAL_MARGINAL_SOLVE_H_
