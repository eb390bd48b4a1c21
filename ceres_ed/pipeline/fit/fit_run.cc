#include "ceres_ed/pipeline/fit/fit_run.h"

#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/pipeline/fit/fit_picture.h>
#include <ceres_ed/pipeline/fit/fit_report.h>
#include <ceres_ed/pipeline/fit/fit_verdict.h>
#include <ceres_ed/pipeline/fit/scale_setting.h>
#include <ceres_ed/pipeline/report.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ceres_ed {
namespace {

// Returns `options` as a run needs them: with its progress, its end, and the time that is left.
FitOptions ObservedOptions(FitOptions options, double seconds_gone, RunObserver* observer) {
  options.time_limit_s = std::max(1e-3, options.time_limit_s - seconds_gone);
  options.should_stop = [observer] { return observer->ShouldStop(); };
  options.on_progress = [observer](const FitProgress& progress) {
    constexpr int kSteps = 100;
    const std::string inliers = ", " + std::to_string(progress.inliers) + " inliers";
    observer->OnProgress(static_cast<int>(std::lround(kSteps * progress.fraction)),
                         kSteps,
                         progress.stage + (progress.stage == "fit" ? inliers : ""));
  };
  return options;
}

bool Fails(Grade grade, FailIf fail_if) {
  switch (fail_if) {
    case FailIf::kDoubtful:
      return grade != Grade::kGood;
    case FailIf::kBad:
      return grade == Grade::kBad;
    case FailIf::kNever:
      break;
  }
  return false;
}

// Writes the results and the report, and returns how the run ended.
Outcome Conclude(FitRun run, const Timer& clock, FitObserver* observer) {
  const FitSettings& settings = *run.settings;
  const FitResult& result = *run.result;
  run.warnings = FitWarnings(run);
  run.verdict = JudgeFit(
      {&result, run.files->source.diagonal, run.files->target.diagonal, MeasureLandmarks(run).rms});
  for (const std::string& warning : run.warnings) observer->OnWarning(warning);
  if (result.IsUsable()) {
    const Timer timer;
    Status status = WriteFitFiles(settings, *run.files, result);
    if (!status.ok()) return Outcome::BadInput(status);
    run.write_s = timer.Seconds();
  }
  run.total_s = clock.Seconds();
  if (!settings.report.empty() || settings.IsLookedAt()) {
    const nlohmann::ordered_json report = FitReport(run);
    Status status = settings.report.empty() ? Status::Ok() : WriteReport(settings.report, report);
    if (status.ok() && result.IsUsable()) status = WriteFitPictures(run, report);
    if (!status.ok()) return Outcome::BadInput(status);
  }
  if (!result.IsUsable()) return Outcome::NoResult(Status::Error(result.message));
  observer->OnEnd(run);
  const bool stopped =
      result.status == SolveStatus::kTimeLimit || result.status == SolveStatus::kInterrupted;
  if (stopped) return Outcome::StoppedEarly(result.message + " in " + settings.output);
  if (Fails(run.verdict.grade, settings.fail_if)) {
    return Outcome::NoResult(
        Status::Error(settings.output + ": the verdict is " + run.verdict.Sentence()));
  }
  return Outcome::Done();
}

// Returns an error if the inputs do not fit together.
Status CheckFitSettings(const FitSettings& settings) {
  if (settings.source_landmarks.empty() != settings.target_landmarks.empty()) {
    return Status::Error(
        "--source_landmarks and --target_landmarks belong together: one is given, "
        "expected both or none");
  }
  const bool has_named =
      !settings.source_landmarks.empty() && settings.landmark_use == LandmarkUse::kFit;
  if (settings.target.empty() && settings.landmarks.empty() && !has_named) {
    return Status::Error("no TARGET and no --landmarks, expected one of them or both");
  }
  return Status::Ok();
}

StatusOr<FitResult> FitFilesWith(const FitFiles& files,
                                 const FitOptions& options,
                                 const SharedSource& shared) {
  const FitInput& input = files.input;
  if (shared.fitter == nullptr) return Fit(input, options, *shared.registry);
  return shared.fitter->FitWith(options, input.target, input.landmarks, input.fixed_points);
}

// Reads, fits and writes. Without a source in `shared`, the source is read, too.
Outcome FitAndConclude(const FitSettings& settings,
                       const SharedSource& shared,
                       const Timer& clock,
                       FitObserver* observer) {
  const auto should_stop = [&] {
    return observer->ShouldStop() || clock.Seconds() >= settings.options.time_limit_s;
  };
  StatusOr<FitFiles> files = shared.source == nullptr
                                 ? LoadFitFiles(settings, should_stop)
                                 : LoadFitFiles(settings, *shared.source, should_stop);
  if (!files.ok()) return Outcome::BadInput(files.status());
  FitOptions options = settings.options;
  if (!settings.scale.empty()) {
    const StatusOr<ScaleSetting> scale = ParseScale(settings.scale);
    if (!scale.ok()) return Outcome::Usage(scale.status().message());
    const std::string note =
        ApplyScale(*scale, files->source.diagonal, files->target.diagonal, &options);
    if (!note.empty()) files->warnings.push_back(note);
  }
  options.record_rounds = !settings.report.empty() || !settings.html.empty();
  const double load_s = clock.Seconds();
  const StatusOr<FitResult> result =
      FitFilesWith(*files, ObservedOptions(options, load_s, observer), shared);
  if (!result.ok()) {
    const std::string inputs =
        settings.source + (settings.target.empty() ? "" : ", " + settings.target);
    return Outcome::BadInput(Status::Error(inputs + ": " + result.status().message()));
  }
  FitRun run{&settings, &*files, &*result, shared.registry, load_s};
  run.initial_scale = options.rigid.initial_scale;
  return Conclude(std::move(run), clock, observer);
}

}  // namespace

LandmarkErrors MeasureLandmarks(const FitRun& run) {
  const FitFiles& files = *run.files;
  std::vector<LandmarkError> named;
  if (run.settings->landmark_use == LandmarkUse::kFit) named = MeasureNamedLandmarks(run);
  const std::size_t by_index =
      files.named.pairs.empty() ? files.input.landmarks.size() : files.named_begin;
  return MeasureLandmarks(files.input, by_index, std::move(named), *run.result);
}

std::vector<LandmarkError> MeasureNamedLandmarks(const FitRun& run) {
  return MeasureLandmarkPairs(run.files->named.pairs,
                              run.files->input.source,
                              run.result->points,
                              run.result->rigid,
                              run.initial_scale);
}

LandmarkErrors SummarizeLandmarks(const std::vector<LandmarkError>& errors,
                                  double LandmarkError::*kind) {
  LandmarkErrors summary;
  summary.count = static_cast<int>(errors.size());
  double sum = 0.0;
  for (const LandmarkError& error : errors) {
    sum += error.*kind * (error.*kind);
    summary.max = std::max(summary.max, error.*kind);
  }
  if (!errors.empty()) summary.rms = std::sqrt(sum / static_cast<double>(errors.size()));
  return summary;
}

LandmarkErrors MeasureLandmarks(const FitInput& input,
                                std::size_t by_index,
                                std::vector<LandmarkError> named,
                                const FitResult& result) {
  for (std::size_t i = 0; i < by_index && !result.points.empty(); ++i) {
    const Landmark& landmark = input.landmarks[i];
    LandmarkError error;
    error.after = (result.points[landmark.point] - landmark.position).norm();
    named.push_back(error);
  }
  LandmarkErrors summary = SummarizeLandmarks(named, &LandmarkError::after);
  if (named.empty()) summary.count = static_cast<int>(by_index);
  return summary;
}

int NumPointRelevant(const FitResult& result) {
  return static_cast<int>(result.point_relevant.size() - std::count(result.point_relevant.begin(),
                                                                    result.point_relevant.end(),
                                                                    0));
}

Outcome RunFit(const FitSettings& settings, const Timer& clock, FitObserver* observer) {
  if (Status status = CheckFitSettings(settings); !status.ok()) {
    return Outcome::Usage(status.message());
  }
  // Check the arguments and the outputs before the computation.
  EnergyRegistry registry;
  Outcome energies = LoadEnergies(settings.plugin, settings.options.extra_energies, &registry);
  if (!energies.done()) return energies;
  const Status status = PrepareOutputs(settings);
  if (!status.ok()) return Outcome::BadInput(status);
  if (const auto scale = ParseScale(settings.scale); !scale.ok()) {
    return Outcome::Usage(scale.status().message());
  }
  return FitAndConclude(settings, {&registry, nullptr, nullptr}, clock, observer);
}

Outcome RunFit(const FitSettings& settings,
               const SharedSource& shared,
               const Timer& clock,
               FitObserver* observer) {
  if (Status status = CheckFitSettings(settings); !status.ok()) {
    return Outcome::Usage(status.message());
  }
  const Status status = PrepareOutputs(settings);
  if (!status.ok()) return Outcome::BadInput(status);
  if (const auto scale = ParseScale(settings.scale); !scale.ok()) {
    return Outcome::Usage(scale.status().message());
  }
  return FitAndConclude(settings, shared, clock, observer);
}

}  // namespace ceres_ed
