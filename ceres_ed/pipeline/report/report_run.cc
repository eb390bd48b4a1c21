#include "ceres_ed/pipeline/report/report_run.h"

#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/pipeline/report/fit_run_files.h>
#include <ceres_ed/pipeline/report/run_reader.h>
#include <ceres_ed/report/html/comparison_page.h>
#include <ceres_ed/report/html/report_json.h>

#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

// Returns an error if there is nothing to see in reports of this program.
Status CheckProgram(const FinishedRun& run) {
  const std::string program = TextOf(run.report, {"program"});
  if (program == "ed_fit") return Status::Ok();
  if (program == "ed_eval" && MemberOf(run.report, {"result", "path"}).is_string()) {
    return Status::Ok();
  }
  return Status::Error(run.path + ": is of a run of '" + program +
                       "', expected one of ed_fit, or of ed_eval on a fit");
}

}  // namespace

Outcome RunReport(const ReportSettings& settings, RunObserver* observer) {
  const LookOutputs outputs = {settings.html, settings.png, settings.theme};
  if (Status status = CheckLookOutputs(outputs); !status.ok()) return Outcome::BadInput(status);
  for (const std::string& output : {settings.html, settings.png}) {
    if (output.empty()) continue;
    if (Status status = PrepareOutput(output); !status.ok()) return Outcome::BadInput(status);
  }
  std::vector<ComparedRun> runs;
  for (const std::string& path : settings.runs) {
    StatusOr<FinishedRun> run = ReadFinishedRun(path);
    if (!run.ok()) return Outcome::BadInput(run.status());
    if (Status status = CheckProgram(*run); !status.ok()) return Outcome::BadInput(status);
    FitRunView files = ReadFitRun(*run, settings.truth);
    for (const std::string& sentence : files.missing) {
      observer->OnWarning(path + ": " + sentence);
    }
    runs.push_back({path, std::move((*run).report), std::move(files.view)});
  }
  const Status status = runs.size() == 1 ? WriteFitLook(outputs, runs[0].report, runs[0].view)
                                         : WriteComparison(outputs, runs);
  return status.ok() ? Outcome::Done() : Outcome::BadInput(status);
}

}  // namespace ceres_ed
