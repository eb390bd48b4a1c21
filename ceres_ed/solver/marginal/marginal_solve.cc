#include "ceres_ed/solver/marginal/marginal_solve.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// The damping of the eliminated nodes as a share of that of Level I; it is little more than
// rounding. The soft modes of a large hidden part have much less curvature than the damping of a
// single node, so that batch solves, which damp all nodes equally, need many steps to follow them.
constexpr double kShareOfDamping = 1e-8;
// If an elimination has more than this factor of the wanted damping, it is repeated.
constexpr double kMaxExcessDamping = 4.0;
constexpr double kMoreDamping = 8.0;
// The number of steps of Level I after a single step was refused. Level I then adapts its own
// damping, and reports if no step is valid.
constexpr int kRetries = 6;
// Decreases below this share of the energy are rounding errors.
constexpr double kRounding = 1e-13;

double SquaredDistance(const DeformationState& a, const DeformationState& b) {
  double sum =
      (a.camera_from_map.rotation.coeffs() - b.camera_from_map.rotation.coeffs()).squaredNorm() +
      (a.camera_from_map.translation - b.camera_from_map.translation).squaredNorm();
  for (int j = 0; j < a.num_nodes(); ++j) {
    for (int i = 0; i < kNodeSize; ++i) {
      const double d = a.node(j)[i] - b.node(j)[i];
      sum += d * d;
    }
  }
  return sum;
}

double SquaredNorm(const DeformationState& state) {
  double sum = state.camera_from_map.translation.squaredNorm() + 1.0;
  for (int j = 0; j < state.num_nodes(); ++j) {
    for (int i = 0; i < kNodeSize; ++i) sum += state.node(j)[i] * state.node(j)[i];
  }
  return sum;
}

}  // namespace

MarginalSolve::MarginalSolve(const MarginalProblem& problem,
                             LevelSolver* level_one_solver,
                             Marginalization* marginalization,
                             DeformationState* state)
    : problem_(problem),
      options_(*problem.options),
      config_(problem.level_one),
      level_one_solver_(level_one_solver),
      marginalization_(marginalization),
      state_(state),
      region_(options_.initial_trust_region_radius),
      least_damping_(kShareOfDamping / region_.radius()),
      damping_(least_damping_) {
  level_two_.num_variable_nodes = static_cast<int>(marginalization->eliminated_nodes().size());
}

// Factorises the linearisation. If hidden nodes are not connected to other nodes (an island), more
// damping is needed to determine them.
bool MarginalSolve::Eliminate() {
  constexpr double kMostDamping = 1e3;
  for (; damping_ <= kMostDamping;
       damping_ = std::max(1.0 / region_.radius(), kMoreDamping * damping_)) {
    if (marginalization_->Eliminate(damping_)) return true;
  }
  return false;
}

// Brings the elimination to the present state. If this is accurate enough, only the gradient is
// updated.
bool MarginalSolve::Prepare(std::string* error) {
  if (is_prepared_) return true;
  const Timer timer;
  const bool keep = marginalization_->has_factor() &&
                    marginalization_->damping() <= kMaxExcessDamping * damping_ &&
                    marginalization_->LargestChange(*state_) <= problem_.relinearize_above;
  is_prepared_ = keep ? marginalization_->Update(*state_, options_.num_threads)
                      : marginalization_->Linearize(*state_, options_.num_threads);
  if (!is_prepared_) {
    *error = "a residual of the nodes to marginalise can't be evaluated";
  } else if (!keep && !Eliminate()) {
    *error = "the nodes to marginalise can't be eliminated";
    is_prepared_ = false;
  }
  level_two_.solve_time_s += timer.Seconds();
  return is_prepared_;
}

bool MarginalSolve::IsDone(SolveSummary* summary) const {
  const auto end = [summary](SolveStatus status, const char* message) {
    summary->status = status;
    summary->message = message;
    return true;
  };
  if (level_two_.iterations >= options_.max_iterations ||
      level_one_.iterations >= options_.max_iterations) {
    return end(SolveStatus::kMaxIterations, "maximum number of iterations reached");
  }
  if (problem_.timer->Seconds() >= options_.time_limit_s) {
    return end(SolveStatus::kTimeLimit, "time limit reached");
  }
  if (options_.should_stop && options_.should_stop()) {
    return end(SolveStatus::kInterrupted, "interrupted");
  }
  if (region_.IsTooSmall()) {
    return end(SolveStatus::kConverged, "trust region too small");
  }
  return false;
}

// Does a step of Level I over camera and PR nodes, with the prior in place of the eliminated
// residuals. Returns false if it failed.
bool MarginalSolve::SolveLevelOne(DeformationState* candidate, SolveSummary* summary) {
  config_.extra_residuals.clear();
  if (!marginalization_->boundary_nodes().empty()) {
    config_.extra_residuals.push_back(marginalization_->PriorResidual());
  }
  SolverOptions options = options_;
  options.max_iterations =
      std::min(level_one_steps_, options_.max_iterations - level_one_.iterations);
  options.initial_trust_region_radius = region_.radius();
  options.time_limit_s = std::max(1e-3, options_.time_limit_s - problem_.timer->Seconds());
  // The caller's request to stop is checked before every step.
  if (level_one_steps_ == 1) options.should_stop = nullptr;
  SolveSummary step;
  const bool solved =
      level_one_solver_->Solve(*problem_.builder, config_, options, candidate, &step);
  summary->status = step.status;
  summary->message = step.message;
  summary->fault = step.fault;
  if (step.levels.empty()) return false;
  TakeOver(step.levels.back());
  if (!solved) return false;
  const LevelSummary& level = step.levels.back();
  level_one_moved_ = level.final_cost < level.initial_cost;
  level_one_converged_ = step.status == SolveStatus::kConverged;
  if (energy_known_) return true;
  // The full energy is the energy of Level I with the eliminated residuals themselves in place of
  // their prior.
  const double prior =
      config_.extra_residuals.empty() ? 0.0 : marginalization_->PriorValue(*state_);
  initial_energy_ = level.initial_cost - prior + marginalization_->energy();
  energy_ = initial_energy_;
  level_two_.initial_cost = marginalization_->energy();
  level_two_.final_cost = marginalization_->energy();
  energy_known_ = true;
  return true;
}

void MarginalSolve::TakeOver(const LevelSummary& level) {
  level_one_.num_variable_nodes = level.num_variable_nodes;
  if (!energy_known_) level_one_.initial_cost = level.initial_cost;
  level_one_.final_cost = level.final_cost;
  level_one_.iterations += level.iterations;
  level_one_.build_time_s += level.build_time_s;
  level_one_.solve_time_s += level.solve_time_s;
}

MarginalSolve::Step MarginalSolve::TakeStep(SolveSummary* summary) {
  if (!Prepare(&summary->message)) {
    summary->status = SolveStatus::kFailed;
    return Step::kFailed;
  }
  DeformationState candidate = *state_;
  if (!SolveLevelOne(&candidate, summary)) return Step::kFailed;
  if (level_one_converged_ && !level_one_moved_ &&
      marginalization_->LargestGradient() <= options_.gradient_tolerance) {
    return Step::kConverged;
  }
  const Timer timer;
  ++level_two_.iterations;
  const double prior = marginalization_->PriorValue(candidate);
  const double rest = level_one_.final_cost - (config_.extra_residuals.empty() ? 0.0 : prior);
  marginalization_->BackSubstitute(&candidate);
  const double step = std::sqrt(SquaredDistance(candidate, *state_));
  const double tolerance = options_.parameter_tolerance;
  Step outcome = Step::kInvalid;
  double energy = 0.0;
  if (!std::isfinite(step)) {
    outcome = Step::kInvalid;
  } else if (!LevelOneWasRefused() &&
             step <= tolerance * (std::sqrt(SquaredNorm(*state_)) + tolerance)) {
    outcome = Step::kConverged;
  } else if (marginalization_->EvaluateEnergy(candidate, options_.num_threads, &energy)) {
    outcome = Judge(rest, prior, energy, &candidate);
  }
  level_two_.solve_time_s += timer.Seconds();
  return outcome;
}

// Accepts the candidate if the full energy decreases as the linearised energy predicts. The full
// energy is `rest` plus the energy of the eliminated residuals; the linearised energy is `rest`
// plus their prior.
MarginalSolve::Step MarginalSolve::Judge(double rest,
                                         double prior,
                                         double eliminated,
                                         DeformationState* candidate) {
  const double predicted = energy_ - (rest + prior);
  const double decrease = energy_ - (rest + eliminated);
  const double quality = decrease / predicted;
  if (!(predicted > 0.0) || !TrustRegion::Accepts(quality)) {
    // If the predicted decrease is within the tolerance, the solve has converged, unless damping is
    // the reason why it is so small.
    const double least = damping_ > least_damping_ ? kRounding : options_.function_tolerance;
    const bool is_least = std::abs(predicted) <= std::max(kRounding, least) * energy_;
    return is_least && !LevelOneWasRefused() ? Step::kConverged : Step::kRejected;
  }
  const double tolerance = options_.function_tolerance * energy_;
  *state_ = std::move(*candidate);
  energy_ = rest + eliminated;
  level_two_.final_cost = eliminated;
  is_prepared_ = false;
  damping_ = std::max(least_damping_, damping_ / kMoreDamping);
  if (LevelOneWasRefused()) {
    region_.Shrink();
    return Step::kAccepted;
  }
  // A Level I with more than one step has adapted its own radius.
  if (level_one_moved_ && level_one_steps_ == 1) {
    region_.Grow(quality);
  }
  return std::abs(decrease) <= tolerance ? Step::kConverged : Step::kAccepted;
}

// Reacts to a refused step. If the linearisation is not fresh, it is renewed first; otherwise the
// whole step, of Level I and of the eliminated nodes, is damped more.
void MarginalSolve::Refuse() {
  const Timer timer;
  if (LevelOneWasRefused()) {
    region_.Shrink();
  } else if (!marginalization_->is_fresh()) {
    is_prepared_ = marginalization_->Linearize(*state_, options_.num_threads) && Eliminate();
  } else {
    damping_ = std::max(1.0 / region_.radius(), kMoreDamping * damping_);
    region_.Shrink();
    is_prepared_ = Eliminate();
  }
  level_two_.solve_time_s += timer.Seconds();
}

void MarginalSolve::Iterate(SolveSummary* summary) {
  int invalid_steps = 0;
  // Each iteration is a step of Level I followed by the back-substitution (Eq. 18 to 21), judged by
  // the full energy.
  while (!IsDone(summary)) {
    const Step step = TakeStep(summary);
    if (step == Step::kFailed) return;
    if (step == Step::kConverged) {
      summary->status = SolveStatus::kConverged;
      summary->message = "function, gradient or parameter tolerance reached";
      return;
    }
    level_one_steps_ = LevelOneWasRefused() ? kRetries : 1;
    if (step == Step::kAccepted) {
      invalid_steps = 0;
      continue;
    }
    if (step == Step::kInvalid && ++invalid_steps >= TrustRegion::kMaxConsecutiveInvalidSteps) {
      summary->status = SolveStatus::kFailed;
      summary->message = "no valid step could be made";
      return;
    }
    Refuse();
  }
}

}  // namespace ceres_ed
