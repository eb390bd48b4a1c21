#include "ceres_ed/solver/block_level_solver.h"

#include <ceres_ed/solver/linear_algebra_backend.h>
#include <ceres_ed/solver/normal_equations.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>

#include <glog/logging.h>

namespace ceres_ed {
namespace {

// Ceres' defaults for what SolverOptions leaves open.
constexpr double kMinRelativeDecrease = 1e-3;
constexpr double kMinTrustRegionRadius = 1e-32;
constexpr double kMaxTrustRegionRadius = 1e16;
constexpr int kMaxConsecutiveInvalidSteps = 5;
// Damping of a parameter that nothing curves, relative to the mean of all.
constexpr double kMinRelativeDiagonal = 1e-6;

// One Levenberg-Marquardt minimisation.
class Minimizer {
 public:
  Minimizer(const NormalEquations& equations,
            const BlockStructure& structure,
            const SolverOptions& options,
            BlockCholesky* cholesky,
            DeformationState* state)
      : equations_(equations),
        structure_(structure),
        options_(options),
        cholesky_(cholesky),
        state_(state),
        radius_(options.initial_trust_region_radius) {}

  void Run(LevelSummary* level, SolveSummary* summary);

 private:
  enum class Step { kAccepted, kRejected, kInvalid, kConverged };

  bool Evaluate(const DeformationState& state, double* cost);
  Step TakeStep(bool last);
  bool IsDone(int iteration, SolveSummary* summary) const;
  void Shrink() {
    radius_ /= decrease_factor_;
    decrease_factor_ *= 2.0;
  }

  const NormalEquations& equations_;
  const BlockStructure& structure_;
  const SolverOptions& options_;
  BlockCholesky* cholesky_;
  DeformationState* state_;
  const Timer timer_;
  double radius_;
  double decrease_factor_ = 2.0;
  double cost_ = 0.0;
  std::vector<double> values_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd diagonal_;
  // The equations at a candidate, swapped in when it is accepted.
  std::vector<double> candidate_values_;
  Eigen::VectorXd candidate_gradient_;
};

// Tests the step that minimises the damped quadratic model, and takes it if the cost follows. The
// equations at the new state are worked out along with its cost unless it is the `last` one.
Minimizer::Step Minimizer::TakeStep(bool last) {
  const double floor = std::max(kMinRelativeDiagonal * diagonal_.mean(), 1e-300);
  const Eigen::VectorXd damping = diagonal_.cwiseMax(floor) / radius_;
  if (!cholesky_->Factorize(values_.data(), damping, options_.num_threads)) return Step::kInvalid;
  const Eigen::VectorXd delta = cholesky_->Solve(-gradient_);
  if (!delta.allFinite()) return Step::kInvalid;
  const double model_decrease =
      0.5 * (delta.dot(damping.cwiseProduct(delta)) - gradient_.dot(delta));
  if (!(model_decrease > 0.0)) return Step::kInvalid;
  const double norm = equations_.ParameterNorm(*state_);
  const double tolerance = options_.parameter_tolerance;
  if (delta.norm() <= tolerance * (norm + tolerance)) return Step::kConverged;

  DeformationState candidate = *state_;
  equations_.Plus(delta, &candidate);
  double candidate_cost = 0.0;
  const bool valid = last
                         ? equations_.EvaluateCost(candidate, options_.num_threads, &candidate_cost)
                         : equations_.Evaluate(candidate,
                                               options_.num_threads,
                                               &candidate_cost,
                                               &candidate_values_,
                                               &candidate_gradient_);
  if (!valid) return Step::kInvalid;
  const double decrease = cost_ - candidate_cost;
  const double quality = decrease / model_decrease;
  if (!(quality > kMinRelativeDecrease)) return Step::kRejected;
  *state_ = std::move(candidate);
  const bool converged = std::abs(decrease) <= options_.function_tolerance * cost_;
  cost_ = candidate_cost;
  if (!last) {
    values_.swap(candidate_values_);
    gradient_.swap(candidate_gradient_);
    diagonal_ = structure_.Diagonal(values_);
  }
  radius_ = std::min(kMaxTrustRegionRadius,
                     radius_ / std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * quality - 1.0, 3)));
  decrease_factor_ = 2.0;
  return converged ? Step::kConverged : Step::kAccepted;
}

// True, with status and message set, when no further iteration is wanted.
bool Minimizer::IsDone(int iteration, SolveSummary* summary) const {
  const auto end = [summary](SolveStatus status, const char* message) {
    summary->status = status;
    summary->message = message;
    return true;
  };
  if (gradient_.lpNorm<Eigen::Infinity>() <= options_.gradient_tolerance) {
    return end(SolveStatus::kConverged, "gradient tolerance reached");
  }
  if (iteration >= options_.max_iterations) {
    return end(SolveStatus::kMaxIterations, "maximum number of iterations reached");
  }
  if (timer_.Seconds() >= options_.time_limit_s) {
    return end(SolveStatus::kTimeLimit, "time limit reached");
  }
  if (options_.should_stop && options_.should_stop()) {
    return end(SolveStatus::kInterrupted, "interrupted");
  }
  if (radius_ < kMinTrustRegionRadius) {
    return end(SolveStatus::kConverged, "trust region too small");
  }
  return false;
}

void Minimizer::Run(LevelSummary* level, SolveSummary* summary) {
  summary->status = SolveStatus::kFailed;
  if (!equations_.Evaluate(*state_, options_.num_threads, &cost_, &values_, &gradient_)) {
    summary->message = "a residual can't be evaluated at the start";
    return;
  }
  diagonal_ = structure_.Diagonal(values_);
  level->initial_cost = cost_;
  level->final_cost = cost_;
  int invalid_steps = 0;
  while (!IsDone(level->iterations, summary)) {
    ++level->iterations;
    const Step step = TakeStep(level->iterations == options_.max_iterations);
    level->final_cost = cost_;
    if (step == Step::kConverged) {
      summary->status = SolveStatus::kConverged;
      summary->message = "function or parameter tolerance reached";
      return;
    }
    if (step == Step::kAccepted) {
      invalid_steps = 0;
      continue;
    }
    Shrink();
    if (step == Step::kInvalid && ++invalid_steps >= kMaxConsecutiveInvalidSteps) {
      summary->message = "no valid step could be made";
      return;
    }
  }
}

}  // namespace

void BlockLevelSolver::UpdateStructure(const ProblemConfig& config, NormalEquations* equations) {
  const std::vector<int> sizes = equations->BlockSizes();
  const bool same_unknowns =
      structure_ != nullptr && variable_nodes_ == config.variable_nodes && sizes_ == sizes;
  if (same_unknowns && equations->SetStructure(structure_.get())) return;
  if (!same_unknowns) pairs_.clear();
  const std::vector<BlockPair> pairs = equations->BlockPairs();
  pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
  variable_nodes_ = config.variable_nodes;
  sizes_ = sizes;
  // The factor refers to the structure: it goes first.
  cholesky_.reset();
  structure_ = std::make_unique<BlockStructure>(sizes_, pairs_);
  pairs_ = structure_->Pairs();
  cholesky_ = std::make_unique<BlockCholesky>(*structure_);
  CHECK(equations->SetStructure(structure_.get()));
}

bool BlockLevelSolver::Solve(const ProblemBuilder& builder,
                             const ProblemConfig& config,
                             const SolverOptions& options,
                             DeformationState* state,
                             SolveSummary* summary) {
  const ScopedSerialLinearAlgebra serial;
  LevelSummary level;
  Timer timer;
  NormalEquations equations(builder, config);
  level.num_variable_nodes = equations.num_variable_nodes();
  if (level.num_variable_nodes == 0 && !equations.camera_variable()) {
    summary->status = SolveStatus::kConverged;
    summary->message = "nothing to move";
    summary->levels.push_back(level);
    return true;
  }
  UpdateStructure(config, &equations);
  level.build_time_s = timer.Restart();
  DeformationState solution = *state;
  Minimizer(equations, *structure_, options, cholesky_.get(), &solution).Run(&level, summary);
  level.solve_time_s = timer.Seconds();
  summary->levels.push_back(level);
  if (!summary->IsUsable()) return false;
  *state = std::move(solution);
  return true;
}

}  // namespace ceres_ed
