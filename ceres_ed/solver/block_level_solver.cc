#include "ceres_ed/solver/block_level_solver.h"

#include <ceres_ed/solver/normal_equations/normal_equations.h>
#include <ceres_ed/solver/trust_region.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// The smallest damping, relative to the mean; it applies to parameters without curvature.
constexpr double kMinRelativeDiagonal = 1e-6;

// The relative residual at which an iterative step may end: the first one, and the bounds of those
// that follow.
constexpr double kFirstTolerance = 0.1;
constexpr double kSmallestTolerance = 1e-4;

// With more variable nodes than this, kAuto solves by conjugate gradients.
constexpr int kManyNodes = 20000;

// A copy of the variable parameters, to undo a step. Its cost does not depend on the rest of the
// state.
class SavedUnknowns {
 public:
  void Save(const NormalEquations& equations, const DeformationState& state) {
    camera_ = state.camera_from_map;
    nodes_.resize(equations.variable_nodes().size() * kNodeSize);
    double* saved = nodes_.data();
    for (const int node : equations.variable_nodes()) {
      saved = std::copy_n(state.node(node), kNodeSize, saved);
    }
  }

  void Restore(const NormalEquations& equations, DeformationState* state) const {
    state->camera_from_map = camera_;
    const double* saved = nodes_.data();
    for (const int node : equations.variable_nodes()) {
      std::copy_n(saved, kNodeSize, state->node(node));
      saved += kNodeSize;
    }
  }

 private:
  CameraPose camera_;
  std::vector<double> nodes_;
};

// One minimisation by the Levenberg-Marquardt method.
class Minimizer {
 public:
  Minimizer(const ProblemBuilder& builder,
            const NormalEquations& equations,
            const BlockStructure& structure,
            const SolverOptions& options,
            StepSolver* step_solver,
            std::vector<double>* values,
            DeformationState* state)
      : builder_(builder),
        equations_(equations),
        structure_(structure),
        options_(options),
        step_solver_(step_solver),
        values_(*values),
        state_(state),
        region_(options.initial_trust_region_radius) {}

  void Run(LevelSummary* level, SolveSummary* summary);

 private:
  enum class Step { kAccepted, kRejected, kInvalid, kConverged };

  bool EvaluateEquations();
  bool SolveForStep(const Eigen::VectorXd& damping, Eigen::VectorXd* delta);
  Step TakeStep(bool last, bool explain);
  bool IsDone(int valid_steps, SolveSummary* summary) const;

  const ProblemBuilder& builder_;
  const NormalEquations& equations_;
  const BlockStructure& structure_;
  const SolverOptions& options_;
  StepSolver* step_solver_;
  std::vector<double>& values_;
  DeformationState* state_;
  const Timer timer_;
  TrustRegion region_;
  double cost_ = 0.0;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd diagonal_;
  // The tolerance of the last step, and the scaled gradient for which it was chosen.
  double tolerance_ = kFirstTolerance;
  double previous_gradient_ = 0.0;
  SavedUnknowns before_;
  // The reason why the last step could not be evaluated, if an explanation was requested.
  std::string fault_;
};

bool Minimizer::EvaluateEquations() {
  if (!equations_.Evaluate(*state_, options_.num_threads, &cost_, &values_, &gradient_)) {
    return false;
  }
  diagonal_ = structure_.Diagonal(values_);
  // A derivative may be infinite or NaN.
  return gradient_.allFinite();
}

// Solves the damped equations. An iterative solver need not be more exact than the linearisation:
// the tolerance follows the decrease of the gradient (Eisenstat and Walker 1996, choice 2), in the
// units of the parameters.
bool Minimizer::SolveForStep(const Eigen::VectorXd& damping, Eigen::VectorXd* delta) {
  const Eigen::VectorXd rhs = -gradient_;
  const int num_rows = structure_.num_primal_rows();
  const double norm =
      std::sqrt(rhs.head(num_rows).cwiseAbs2().cwiseQuotient(damping.head(num_rows)).sum() /
                region_.radius());
  if (previous_gradient_ > 0.0) {
    const double ratio = norm / previous_gradient_;
    tolerance_ = std::clamp(0.9 * ratio * ratio, kSmallestTolerance, kFirstTolerance);
  }
  previous_gradient_ = norm;
  StepSystem system;
  system.values = values_.data();
  system.damping = &damping;
  system.rhs = &rhs;
  system.tolerance = tolerance_;
  system.num_threads = options_.num_threads;
  if (options_.should_stop) system.should_stop = &options_.should_stop;
  return step_solver_->Solve(system, delta);
}

// Computes the step that minimises the damped quadratic model, and takes it if it decreases the
// cost enough. The equations at the new state are evaluated unless this is the last step. With
// `explain`, the reason for an invalid step is determined.
Minimizer::Step Minimizer::TakeStep(bool last, bool explain) {
  // The damped normal equations (H + D / radius) delta = -g, where D is the diagonal of H.
  const int num_rows = structure_.num_primal_rows();
  const double floor = std::max(kMinRelativeDiagonal * diagonal_.head(num_rows).mean(), 1e-300);
  Eigen::VectorXd damping = Eigen::VectorXd::Zero(structure_.num_rows());
  damping.head(num_rows) = diagonal_.head(num_rows).cwiseMax(floor) / region_.radius();
  Eigen::VectorXd delta;
  if (!SolveForStep(damping, &delta)) return Step::kInvalid;
  delta.tail(structure_.num_rows() - num_rows).setZero();
  if (!delta.allFinite()) return Step::kInvalid;
  // The decrease that the quadratic model predicts for this step. It also holds for an inexact one
  // (StepSolver::Solve()).
  const double model_decrease =
      0.5 * (delta.dot(damping.cwiseProduct(delta)) - gradient_.dot(delta));
  if (!(model_decrease > 0.0)) return Step::kInvalid;
  const double norm = equations_.ParameterNorm(*state_);
  const double tolerance = options_.parameter_tolerance;
  if (delta.norm() <= tolerance * (norm + tolerance)) return Step::kConverged;

  before_.Save(equations_, *state_);
  equations_.Plus(delta, state_);
  double candidate_cost = 0.0;
  // Only the cost is evaluated here: the matrix is the largest object, and a second copy is not
  // needed.
  const bool valid = equations_.EvaluateCost(*state_, options_.num_threads, &candidate_cost);
  const double decrease = cost_ - candidate_cost;
  const double quality = decrease / model_decrease;
  if (!valid || !TrustRegion::Accepts(quality)) {
    if (!valid && explain) fault_ = builder_.CheckResiduals(*state_).message();
    before_.Restore(equations_, state_);
    return valid ? Step::kRejected : Step::kInvalid;
  }
  const bool converged = std::abs(decrease) <= options_.function_tolerance * cost_;
  cost_ = candidate_cost;
  if (!last && !converged && !EvaluateEquations()) {
    // The cost is finite at the new state but a derivative is not: return to the old state, where
    // both are.
    if (explain) fault_ = builder_.CheckResiduals(*state_).message();
    before_.Restore(equations_, state_);
    EvaluateEquations();
    return Step::kInvalid;
  }
  region_.Grow(quality);
  return converged ? Step::kConverged : Step::kAccepted;
}

// Returns true, with status and message set, if no further iteration is needed.
bool Minimizer::IsDone(int valid_steps, SolveSummary* summary) const {
  const auto end = [summary](SolveStatus status, const char* message) {
    summary->status = status;
    summary->message = message;
    return true;
  };
  if (gradient_.lpNorm<Eigen::Infinity>() <= options_.gradient_tolerance) {
    return end(SolveStatus::kConverged, "gradient tolerance reached");
  }
  if (valid_steps >= options_.max_iterations) {
    return end(SolveStatus::kMaxIterations, "maximum number of iterations reached");
  }
  if (timer_.Seconds() >= options_.time_limit_s) {
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

void Minimizer::Run(LevelSummary* level, SolveSummary* summary) {
  summary->status = SolveStatus::kFailed;
  if (!EvaluateEquations()) {
    ExplainFailure(builder_, *state_, "a residual can't be evaluated at the start", summary);
    return;
  }
  level->initial_cost = cost_;
  level->final_cost = cost_;
  // Invalid steps do not count toward the limit. Otherwise a solve with a limit of one step could
  // end where it began, without any sign of it.
  int valid_steps = 0;
  int invalid_steps = 0;
  while (!IsDone(valid_steps, summary)) {
    ++level->iterations;
    const bool last = valid_steps + 1 == options_.max_iterations;
    const Step step = TakeStep(last, invalid_steps + 1 == TrustRegion::kMaxConsecutiveInvalidSteps);
    level->final_cost = cost_;
    if (step == Step::kConverged) {
      summary->status = SolveStatus::kConverged;
      summary->message = "function or parameter tolerance reached";
      return;
    }
    if (step != Step::kInvalid) ++valid_steps;
    if (step == Step::kAccepted) {
      invalid_steps = 0;
      continue;
    }
    region_.Shrink();
    if (step == Step::kInvalid && ++invalid_steps >= TrustRegion::kMaxConsecutiveInvalidSteps) {
      ExplainFailure(builder_, *state_, "no valid step could be made", summary);
      if (summary->fault.empty() && !fault_.empty()) {
        summary->fault = fault_;
        summary->message += ": " + fault_;
      }
      return;
    }
  }
}

}  // namespace

std::unique_ptr<StepSolver> BlockLevelSolver::MakeStepSolver(const DeformationGraph& graph) {
  const std::vector<int>& nodes = equations_.variable_nodes();
  const bool iterative =
      linear_solver_ == LinearSolver::kPcg ||
      (linear_solver_ == LinearSolver::kAuto && static_cast<int>(nodes.size()) >= kManyNodes);
  if (!iterative) return MakeFactorStep(*structure_, &memory_);
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(nodes.size());
  for (const int node : nodes) positions.push_back(graph.position(node));
  return MakeGradientStep(*structure_, positions, preconditioner_);
}

void BlockLevelSolver::UpdateStructure(const ProblemBuilder& builder, const ProblemConfig& config) {
  const std::vector<int> sizes = equations_.BlockSizes();
  const bool same_unknowns =
      structure_ != nullptr && variable_nodes_ == config.variable_nodes && sizes_ == sizes;
  if (same_unknowns && equations_.SetStructure(structure_.get())) return;
  // Dual blocks belong to single points, which are different in the next problem.
  if (!same_unknowns || equations_.num_dual() > 0) pairs_.clear();
  const std::vector<BlockPair> pairs = equations_.BlockPairs();
  pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
  variable_nodes_ = config.variable_nodes;
  sizes_ = sizes;
  // The step solver refers to the structure, so it is destroyed first.
  step_solver_.reset();
  structure_ = std::make_unique<BlockStructure>(sizes_, pairs_, equations_.num_dual());
  pairs_ = structure_->Pairs();
  step_solver_ = MakeStepSolver(builder.graph());
  CHECK(equations_.SetStructure(structure_.get()));
}

bool BlockLevelSolver::Solve(const ProblemBuilder& builder,
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
  equations_.Build(builder, config, DualResiduals::kWhereTheyPay);
  level.num_variable_nodes = equations_.num_variable_nodes();
  if (level.num_variable_nodes == 0 && !equations_.camera_variable()) {
    summary->status = SolveStatus::kConverged;
    summary->message = "nothing to move";
    summary->levels.push_back(level);
    return true;
  }
  UpdateStructure(builder, config);
  level.build_time_s = timer.Restart();
  SavedUnknowns before;
  before.Save(equations_, *state);
  Minimizer(builder, equations_, *structure_, options, step_solver_.get(), &values_, state)
      .Run(&level, summary);
  level.solve_time_s = timer.Seconds();
  summary->levels.push_back(level);
  if (!summary->IsUsable()) before.Restore(equations_, state);
  return summary->IsUsable();
}

}  // namespace ceres_ed
