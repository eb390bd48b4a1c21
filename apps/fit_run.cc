#include "apps/fit_run.h"

#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/registration/fit.h>
#include <ceres_ed/util/timer.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <apps/fit_files.h>
#include <apps/fit_flags.h>
#include <apps/fit_report.h>
#include <apps/support/progress_bar.h>
#include <apps/support/run_flags.h>

namespace ceres_ed {
namespace {

StatusOr<FitResult> FitWithProgress(const FitInput& input,
                                    FitCommand settings,
                                    double seconds_gone,
                                    const EnergyRegistry& registry) {
  FitOptions& options = settings.options;
  options.time_limit_s = std::max(1e-3, options.time_limit_s - seconds_gone);
  options.should_stop = [] { return StopRequested(); };
  constexpr int kSteps = 100;
  ProgressBar bar("ed_fit", kSteps, settings.quiet);
  options.on_progress = [&bar](const FitProgress& progress) {
    bar.Update(static_cast<int>(std::lround(kSteps * progress.fraction)),
               progress.stage + ", " + std::to_string(progress.inliers) + " inliers");
  };
  return Fit(input, options, registry);
}

// Writes what there is and says how the run ended.
Outcome Conclude(FitRun run, bool quiet, const Timer& clock) {
  const FitSettings& settings = *run.settings;
  const FitResult& result = *run.result;
  run.warnings = FitWarnings(run);
  for (const std::string& warning : run.warnings) {
    std::fprintf(stderr, "ed_fit: warning: %s\n", warning.c_str());
  }
  if (result.IsUsable()) {
    const Timer timer;
    Status status = WriteFitFiles(settings, *run.files, result);
    if (!status.ok()) return Outcome::BadInput(status);
    run.write_s = timer.Seconds();
  }
  run.total_s = clock.Seconds();
  if (!settings.report.empty()) {
    Status status = WriteReport(settings.report, FitReport(run));
    if (!status.ok()) return Outcome::BadInput(status);
  }
  if (!result.IsUsable()) return Outcome::NoResult(Status::Error(result.message));
  if (!quiet) std::fputs(FitSummary(run).c_str(), stdout);
  const bool stopped =
      result.status == SolveStatus::kTimeLimit || result.status == SolveStatus::kInterrupted;
  return stopped ? Outcome::StoppedEarly(result.message + " in " + settings.output)
                 : Outcome::Done();
}

}  // namespace

Outcome RunFit(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  StatusOr<FitCommand> settings = ReadFitFlags();
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  settings->flags = CurrentFlags();
  if (arguments.size() == 1 && settings->landmarks.empty()) {
    return Outcome::Usage("no TARGET and no --landmarks, expected one of them or both");
  }
  EnergyRegistry registry;
  const Outcome energies =
      LoadEnergies(settings->plugin, settings->options.extra_energies, &registry);
  if (energies.code != ExitCode::kDone) return energies;
  const Status status = CheckOutputs(*settings);
  if (!status.ok()) return Outcome::BadInput(status);

  const StatusOr<FitFiles> files = LoadFitFiles(arguments, *settings);
  if (!files.ok()) return Outcome::BadInput(files.status());
  const double load_s = clock.Seconds();
  const StatusOr<FitResult> result = FitWithProgress(files->input, *settings, load_s, registry);
  if (!result.ok()) {
    const std::string inputs = arguments[0] + (arguments.size() > 1 ? ", " + arguments[1] : "");
    return Outcome::BadInput(Status::Error(inputs + ": " + result.status().message()));
  }
  return Conclude({&*settings, &*files, &*result, &registry, load_s}, settings->quiet, clock);
}

}  // namespace ceres_ed
