#include "ceres_ed/registration/coarse_to_fine.h"

#include <ceres_ed/registration/hypotheses/explanation.h>
#include <ceres_ed/registration/hypotheses/model_selection.h>
#include <ceres_ed/registration/hypotheses/rigid_check.h>
#include <ceres_ed/registration/uncertainty/fit_uncertainty.h>

#include <algorithm>
#include <string>
#include <utility>

namespace ceres_ed {
namespace {

// The distance at which a point counts half as unmatched, as a fraction of the source's diagonal,
// while finalists are compared, and that distance in standard deviations of the noise.
constexpr double kFineWidth = 0.0025;
constexpr double kFineWidthPerNoise = 3.0;

}  // namespace

Status CoarseToFine::FollowFinest(Attempt* attempt,
                                  std::unique_ptr<FitProblem>* problem,
                                  FitResult* result) const {
  const int last = graphs_->finest();
  const BuiltGraph& graph = (*graphs_)[last];
  attempt->state = graphs_->CarryOver(attempt->state, attempt->graph, last);
  attempt->graph = last;
  StatusOr<std::unique_ptr<FitProblem>> made = FitProblem::Create(fit_, graph, /*is_last=*/true);
  if (!made.ok()) return made.status();
  *problem = *std::move(made);
  const ResolutionPlan plan = attempt->hypothesis.Apply(plans_[last], /*is_finest=*/true);
  RunNonrigidLoop(fit_, graph, plan, problem->get(), &attempt->state, result);
  return Status::Ok();
}

void CoarseToFine::Note(const Attempt& attempt) {
  if (!fit_.options->covariance) return;
  ways_.Add(fit_.source->cloud().points,
            (*graphs_)[attempt.graph],
            attempt.state,
            fit_.options->num_threads);
}

void CoarseToFine::Take(Attempt attempt, FitResult* result) {
  graph_ = attempt.graph;
  state_ = std::move(attempt.state);
  result->hypothesis = attempt.hypothesis.name;
}

Status CoarseToFine::FollowFine(std::vector<Attempt> attempts, FitResult* result) {
  FitResult best_result;
  const double width = std::max(kFineWidth, kFineWidthPerNoise * fit_.noise);
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    Attempt& attempt = attempts[i];
    FitResult trial = *result;
    std::unique_ptr<FitProblem> problem;
    Status status = FollowFinest(&attempt, &problem, &trial);
    if (!status.ok()) return status;
    if (attempts.size() > 1) {
      attempt.left =
          MeasureExplanation(fit_, (*graphs_)[attempt.graph], attempt.state, width).AmongWays() +
          attempt.hypothesis.handicap;
    }
    // What the trials have cost is counted, whichever is taken.
    result->times = trial.times;
    result->outer_iterations = trial.outer_iterations;
    result->solver_iterations = trial.solver_iterations;
    const bool is_stopped = trial.EndedEarly();
    if (i == 0 || (!is_stopped && attempt.left < attempts[0].left)) {
      best_result = std::move(trial);
      problem_ = std::move(problem);
      if (i > 0) std::swap(attempts[0], attempts[i]);
    }
    if (i > 0) Note(attempts[i]);
    if (is_stopped) break;
  }
  best_result.times = result->times;
  best_result.outer_iterations = result->outer_iterations;
  best_result.solver_iterations = result->solver_iterations;
  *result = std::move(best_result);
  Take(std::move(attempts[0]), result);
  return Status::Ok();
}

Status CoarseToFine::Run(FitResult* result) {
  StatusOr<GraphPyramid> graphs = GraphPyramid::Build(fit_, fit_.options->schedule.levels, result);
  if (!graphs.ok()) return graphs.status();
  graphs_ = *std::move(graphs);
  plans_ = PlanResolutions(fit_, graphs_->size());
  graph_ = graphs_->finest();
  state_ = DeformationState(graph().graph.num_nodes());
  if (MustEnd(fit_, result)) return Status::Ok();
  if (graph_ == 0) {
    StatusOr<std::unique_ptr<FitProblem>> problem =
        FitProblem::Create(fit_, graph(), /*is_last=*/true);
    if (!problem.ok()) return problem.status();
    problem_ = *std::move(problem);
    RunNonrigidLoop(fit_, graph(), plans_[graph_], problem_.get(), &state_, result);
    Conclude(result);
    return Status::Ok();
  }
  StatusOr<std::vector<Attempt>> attempts = Portfolio(fit_, *graphs_, plans_).Try(result);
  if (!attempts.ok()) return attempts.status();
  if (result->EndedEarly()) {
    Take(std::move(attempts->front()), result);
    return Status::Ok();
  }
  for (const Attempt& attempt : *attempts) Note(attempt);
  Status status = FollowFine(Finalists(*std::move(attempts)), result);
  if (status.ok()) Conclude(result);
  return status;
}

void CoarseToFine::Conclude(FitResult* result) {
  const std::string reason = WhyRigidIsBetter(fit_, graph(), state_);
  if (!reason.empty()) {
    result->warnings.push_back(reason);
    result->rigid_only = true;
    if (fit_.options->covariance) DropUncertainty("the deformation was left out", result);
    state_ = DeformationState(graph().graph.num_nodes());
    result->final_energy = result->initial_energy;
  } else if (fit_.options->covariance && !result->EndedEarly()) {
    MeasureUncertainty(fit_, graph(), state_, ways_, problem_.get(), result);
  }
  // What follows needs memory of its own.
  problem_.reset();
  if (result->rigid_only || result->EndedEarly()) return;
  std::optional<DeformationState> rigid = RigidModel(fit_, graph(), state_);
  if (!rigid) return;
  state_ = *std::move(rigid);
  result->rigid_suffices = true;
}

}  // namespace ceres_ed
