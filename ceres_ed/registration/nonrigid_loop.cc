#include "ceres_ed/registration/nonrigid_loop.h"

#include <ceres_ed/registration/fit_progress.h>
#include <ceres_ed/registration/moving_samples.h>
#include <ceres_ed/solver/decoupling/information_loss.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

constexpr int kPatientIterations = 12;
// The unit of the noise is a hundredth of the source's diagonal.
constexpr double kPerLength = 100.0;
// All steps before the last one match 1 / kShareOfSteps of the samples, and all resolutions before
// the last one match 1 / kShareOfResolutions of them.
constexpr int kShareOfSteps = 2;
constexpr int kShareOfResolutions = 8;

// The information that is lost is not measured on larger graphs: it takes a factor of all nodes.
constexpr int kMostMeasuredNodes = 20000;

class NonrigidLoop {
 public:
  NonrigidLoop(const UnitFit& fit,
               const BuiltGraph& graph,
               const ResolutionPlan& plan,
               FitProblem* problem,
               DeformationState* state,
               FitResult* result)
      : fit_(fit),
        source_(*fit.source),
        target_(fit.target),
        options_(*fit.options),
        clock_(*fit.clock),
        graph_(graph),
        plan_(plan),
        problem_(problem),
        state_(state),
        result_(result),
        strategy_(MakeStrategy(options_.strategy)),
        moving_(source_, graph, plan.samples) {}

  void Run();

 private:
  enum class RoundOutcome { kMoving, kStill, kStopped };

  void TakeSamples(int count);
  RoundOutcome RunRound(int max_iterations);
  void Match();
  SolveSummary Solve(int max_iterations);
  void MeasureInitialEnergy();
  void MeasureInformationLost();
  void RecordRound();
  bool Stopped() { return MustEnd(fit_, result_); }
  // Asks whether the next step is worth its time.
  bool KeepsGoing(int step) const;
  void Report(double part) const;

  const UnitFit& fit_;
  const Surface& source_;
  const Surface* target_;
  const FitOptions& options_;
  const Timer& clock_;
  const BuiltGraph& graph_;
  const ResolutionPlan& plan_;
  FitProblem* problem_;
  DeformationState* state_;
  FitResult* result_;
  std::unique_ptr<Strategy> strategy_;
  MovingSamples moving_;
  std::vector<int> target_samples_;
  MatchMemory memory_;
  double energy_ = 0.0;
  // The PI nodes that the last Level I moved.
  std::vector<int> active_hidden_;
  double stiffness_ = 1.0;
  bool initial_energy_known_ = false;
};

void NonrigidLoop::Report(double part) const {
  if (!options_.on_progress) return;
  options_.on_progress({"fit",
                        PartOfFit("fit", part),
                        result_->matches.inliers,
                        result_->matches.rms_plane,
                        energy_});
}

void NonrigidLoop::Match() {
  const Timer timer;
  MatchingOptions matching = options_.matching;
  matching.max_angle_deg = plan_.max_angle_deg;
  matching.with_details = !options_.extra_energies.empty();
  result_->matches = MatchBothWays(moving_.Moved(), *target_, target_samples_, matching, &memory_);
  const double width =
      plan_.loss_width * std::max(result_->matches.robust_distance, options_.matching.resolution);
  problem_->SetMatches(result_->matches, std::max(width, 1e-12));
  result_->times.associate += timer.Seconds();
}

SolveSummary NonrigidLoop::Solve(int max_iterations) {
  SolverOptions options;
  options.max_iterations = max_iterations;
  options.num_threads = options_.num_threads;
  options.time_limit_s = std::max(1e-3, options_.time_limit_s - clock_.Seconds());
  options.should_stop = options_.should_stop;
  SolveSummary summary = strategy_->Solve(problem_->builder(), options, state_);
  for (std::size_t i = 0; i < summary.levels.size(); ++i) {
    const LevelSummary& level = summary.levels[i];
    result_->times.build += level.build_time_s;
    result_->times.solve += level.solve_time_s;
    (i == 0 ? result_->times.level1 : result_->times.level2) += level.solve_time_s;
  }
  result_->solver_iterations += summary.TotalIterations();
  result_->held_share = summary.active_set.held_share;
  active_hidden_ = std::move(summary.active_set.hidden_nodes);
  result_->active_hidden = static_cast<int>(active_hidden_.size());
  energy_ = summary.final_energy;
  return summary;
}

// Computes the energy without deformation with the final weights, for comparison with final_energy.
void NonrigidLoop::MeasureInitialEnergy() {
  initial_energy_known_ = true;
  problem_->SetStiffness(1.0);
  result_->initial_energy =
      problem_->builder().Evaluate(DeformationState(graph_.graph.num_nodes()));
  problem_->SetStiffness(stiffness_);
}

// Computes what the observed nodes owe to the held ones, once for a fit that asked for it.
void NonrigidLoop::MeasureInformationLost() {
  const StrategyOptions& strategy = options_.strategy;
  if (strategy.mode != SolveMode::kTwoLevel || strategy.active != ActiveSetRule::kInformation ||
      graph_.graph.num_nodes() > kMostMeasuredNodes) {
    return;
  }
  std::vector<char> moved = result_->point_relevant;
  for (const int node : active_hidden_) moved[node] = 1;
  const StatusOr<double> lost = MeasureInformationLoss(
      problem_->builder(), result_->point_relevant, moved, *state_, options_.num_threads);
  if (lost.ok()) result_->information_lost = *lost;
}

void NonrigidLoop::RecordRound() {
  if (!options_.record_rounds || !plan_.is_last) return;
  const Matches& matches = result_->matches;
  problem_->SetStiffness(plan_.last_stiffness);
  result_->rounds.push_back(
      {stiffness_, matches.inliers, matches.rms_plane, problem_->builder().Evaluate(*state_)});
  problem_->SetStiffness(stiffness_);
}

NonrigidLoop::RoundOutcome NonrigidLoop::RunRound(int max_iterations) {
  if (target_ != nullptr) Match();
  if (!initial_energy_known_ && plan_.is_last) MeasureInitialEnergy();
  SolveSummary summary = Solve(max_iterations);
  // A refused step only reduces the trust region; it does not mean that nothing moves.
  if (summary.status == SolveStatus::kMaxIterations &&
      !(summary.final_energy < summary.initial_energy)) {
    summary = Solve(kPatientIterations);
  }
  ++result_->outer_iterations;
  if (!summary.IsUsable()) {
    result_->status = SolveStatus::kFailed;
    result_->message = summary.message;
    return RoundOutcome::kStopped;
  }
  const double motion = moving_.Move(*state_, options_.num_threads);
  RecordRound();
  if (Stopped()) return RoundOutcome::kStopped;
  return motion < options_.schedule.tolerance ? RoundOutcome::kStill : RoundOutcome::kMoving;
}

void NonrigidLoop::TakeSamples(int count) {
  moving_ = MovingSamples(source_, graph_, count);
  moving_.Move(*state_, options_.num_threads);
  if (target_ != nullptr) target_samples_ = SamplePoints(*target_, count);
  memory_ = {};
}

bool NonrigidLoop::KeepsGoing(int step) const {
  if (!plan_.keep_going || target_ == nullptr || step + 1 == plan_.steps) return true;
  return plan_.keep_going(
      step,
      FindUnmatched(
          moving_.Moved(), *target_, target_samples_, plan_.unmatched_width, options_.matching));
}

void NonrigidLoop::Run() {
  const FitSchedule& schedule = options_.schedule;
  TakeSamples(plan_.samples);
  RoundOutcome outcome = RoundOutcome::kMoving;
  for (int step = 0; step < plan_.steps && outcome != RoundOutcome::kStopped; ++step) {
    const double part = plan_.steps > 1 ? double(step) / (plan_.steps - 1) : 1.0;
    stiffness_ =
        plan_.first_stiffness * std::pow(plan_.last_stiffness / plan_.first_stiffness, part);
    problem_->SetStiffness(stiffness_);
    if (step + 1 == plan_.steps && plan_.last_samples != plan_.samples) {
      TakeSamples(plan_.last_samples);
    }
    for (int round = 0; round < schedule.max_rounds; ++round) {
      outcome = RunRound(schedule.solver_iterations);
      const double done = (step + double(round + 1) / schedule.max_rounds) / plan_.steps;
      Report(plan_.progress_begin + done * (plan_.progress_end - plan_.progress_begin));
      if (outcome != RoundOutcome::kMoving) break;
    }
    if (outcome != RoundOutcome::kStopped && !KeepsGoing(step)) break;
  }
  if (outcome != RoundOutcome::kStopped) {
    const bool still = outcome == RoundOutcome::kStill;
    result_->status = still ? SolveStatus::kConverged : SolveStatus::kMaxIterations;
    result_->message = still ? "the surface stands still" : "all rounds of the schedule are done";
  }
  result_->point_relevant = problem_->builder().PointRelevantNodes();
  if (plan_.is_last || outcome == RoundOutcome::kStopped) {
    if (!initial_energy_known_) MeasureInitialEnergy();
    result_->final_energy = problem_->builder().Evaluate(*state_);
    MeasureInformationLost();
  }
}

}  // namespace

bool MustEnd(const UnitFit& fit, FitResult* result) {
  if (fit.options->should_stop && fit.options->should_stop()) {
    result->status = SolveStatus::kInterrupted;
    result->message = "interrupted; best state so far";
    return true;
  }
  if (fit.clock->Seconds() >= fit.options->time_limit_s) {
    result->status = SolveStatus::kTimeLimit;
    result->message = "time limit reached; best state so far";
    return true;
  }
  return false;
}

std::vector<ResolutionPlan> PlanResolutions(const UnitFit& fit, int resolutions) {
  const FitOptions& options = *fit.options;
  const FitSchedule& schedule = options.schedule;
  const double of_noise = schedule.noise_stiffness * std::pow(kPerLength * fit.noise, 3);
  const double initial_stiffness =
      fit.target != nullptr ? schedule.initial_stiffness + of_noise : 1.0;
  const double final_stiffness = fit.target != nullptr ? schedule.final_stiffness + of_noise : 1.0;
  const int coarse_resolutions = resolutions - 1;
  // A resolution starts with the final stiffness of the resolution before it.
  const int coarse_steps =
      coarse_resolutions > 0 ? std::max(1, schedule.coarse_steps / coarse_resolutions) : 0;
  const int ratios =
      std::max(1, coarse_resolutions * std::max(0, coarse_steps - 1) + schedule.fine_steps - 1);
  const double ratio = std::pow(final_stiffness / initial_stiffness, 1.0 / ratios);
  std::vector<ResolutionPlan> plans(resolutions);
  double stiffness = initial_stiffness;
  for (int resolution = 0; resolution < resolutions; ++resolution) {
    ResolutionPlan& plan = plans[resolution];
    const bool last = resolution == coarse_resolutions;
    plan.max_angle_deg = options.matching.max_angle_deg;
    plan.is_last = last;
    plan.steps = last ? schedule.fine_steps : coarse_steps;
    plan.loss_width = last ? options.loss_width : options.careful_loss_width;
    plan.first_stiffness = stiffness;
    stiffness = last ? final_stiffness : stiffness * std::pow(ratio, plan.steps - 1);
    plan.last_stiffness = stiffness;
    plan.progress_begin = static_cast<double>(resolution) / resolutions;
    plan.progress_end = static_cast<double>(resolution + 1) / resolutions;
  }
  const auto samples = [&](int share) {
    return std::min(options.max_samples, std::max(kMinCoarseSamples, options.max_samples / share));
  };
  for (int resolution = 0; resolution < resolutions; ++resolution) {
    const bool last = resolution == coarse_resolutions;
    plans[resolution].samples = samples(last ? kShareOfSteps : kShareOfResolutions);
    plans[resolution].last_samples = last ? options.max_samples : plans[resolution].samples;
  }
  return plans;
}

void RunNonrigidLoop(const UnitFit& fit,
                     const BuiltGraph& graph,
                     const ResolutionPlan& plan,
                     FitProblem* problem,
                     DeformationState* state,
                     FitResult* result) {
  NonrigidLoop(fit, graph, plan, problem, state, result).Run();
}

}  // namespace ceres_ed
