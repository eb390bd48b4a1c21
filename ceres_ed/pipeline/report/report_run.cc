#include "ceres_ed/pipeline/report/report_run.h"

#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/pipeline/report/fit_run_files.h>
#include <ceres_ed/pipeline/report/run_reader.h>
#include <ceres_ed/pipeline/report/slam_run_files.h>
#include <ceres_ed/report/html/comparison_page.h>
#include <ceres_ed/report/html/report_json.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

// What there is to see of a run.
enum class RunKind { kFit, kSequence };

// Returns the kind of a run; an error if there is nothing to see in reports of its program.
StatusOr<RunKind> KindOf(const FinishedRun& run) {
  const std::string program = TextOf(run.report, {"program"});
  if (program == "ed_fit") return RunKind::kFit;
  if (program == "ed_slam") return RunKind::kSequence;
  if (program == "ed_eval" && MemberOf(run.report, {"result", "path"}).is_string()) {
    const bool of_sequence = MemberOf(run.report, {"sequence", "path"}).is_string();
    return of_sequence ? RunKind::kSequence : RunKind::kFit;
  }
  return Status::Error(run.path + ": is of a run of '" + program +
                       "', expected one of ed_fit, ed_slam or ed_eval");
}

void Warn(const std::string& path,
          const std::vector<std::string>& sentences,
          RunObserver* observer) {
  for (const std::string& sentence : sentences) observer->OnWarning(path + ": " + sentence);
}

Status ShowFits(const ReportSettings& settings,
                const LookOutputs& outputs,
                std::vector<FinishedRun> runs,
                RunObserver* observer) {
  std::vector<ComparedRun> compared;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    FitRunView files = ReadFitRun(runs[i], settings.truth);
    Warn(settings.runs[i], files.missing, observer);
    compared.push_back({settings.runs[i], std::move(runs[i].report), std::move(files.view)});
  }
  return compared.size() == 1 ? WriteFitLook(outputs, compared[0].report, compared[0].view)
                              : WriteComparison(outputs, compared);
}

Status ShowSequences(const ReportSettings& settings,
                     const LookOutputs& outputs,
                     std::vector<FinishedRun> runs,
                     RunObserver* observer) {
  std::vector<ComparedSequence> compared;
  nlohmann::ordered_json evaluation;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    FinishedRun run = std::move(runs[i]);
    if (TextOf(run.report, {"program"}) == "ed_eval") {
      // The result that was measured has the run.
      evaluation = run.report;
      StatusOr<FinishedRun> measured =
          ReadFinishedRun(run.Find(TextOf(run.report, {"result", "path"})));
      if (!measured.ok()) return measured.status();
      run = *std::move(measured);
    }
    SlamRunView files = ReadSlamRun(run, "", /*with_truth=*/true);
    Warn(settings.runs[i], files.missing, observer);
    compared.push_back({settings.runs[i], std::move(run.report), std::move(files.view)});
  }
  return compared.size() == 1
             ? WriteSequenceLook(outputs, compared[0].report, evaluation, compared[0].view)
             : WriteSequenceComparison(outputs, compared);
}

}  // namespace

Outcome RunReport(const ReportSettings& settings, RunObserver* observer) {
  const LookOutputs outputs = {settings.html, settings.png, settings.theme};
  if (Status status = PrepareLook(outputs); !status.ok()) return Outcome::BadInput(status);
  std::vector<FinishedRun> runs;
  std::optional<RunKind> kind;
  for (const std::string& path : settings.runs) {
    StatusOr<FinishedRun> run = ReadFinishedRun(path);
    if (!run.ok()) return Outcome::BadInput(run.status());
    const StatusOr<RunKind> this_kind = KindOf(*run);
    if (!this_kind.ok()) return Outcome::BadInput(this_kind.status());
    if (kind && *kind != *this_kind) {
      return Outcome::BadInput(
          Status::Error(path + ": is of another kind than " + settings.runs[0] +
                        ", expected runs of ed_fit alone, or of ed_slam alone, beside each other"));
    }
    kind = *this_kind;
    runs.push_back(*std::move(run));
  }
  if (runs.empty()) return Outcome::Usage("no run is given, expected one or more");
  const Status status = *kind == RunKind::kFit
                            ? ShowFits(settings, outputs, std::move(runs), observer)
                            : ShowSequences(settings, outputs, std::move(runs), observer);
  return status.ok() ? Outcome::Done() : Outcome::BadInput(status);
}

}  // namespace ceres_ed
