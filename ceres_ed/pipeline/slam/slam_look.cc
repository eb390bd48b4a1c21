#include "ceres_ed/pipeline/slam/slam_look.h"

#include <ceres_ed/pipeline/look.h>
#include <ceres_ed/pipeline/report/run_reader.h>
#include <ceres_ed/pipeline/report/slam_run_files.h>

namespace ceres_ed {
namespace {

LookOutputs OutputsOf(const SlamSettings& settings) {
  return {settings.html, settings.png, settings.theme};
}

}  // namespace

Status PrepareSlamLook(const SlamSettings& settings) { return PrepareLook(OutputsOf(settings)); }

Status WriteSlamLook(const SlamSettings& settings) {
  const LookOutputs outputs = OutputsOf(settings);
  if (outputs.empty()) return Status::Ok();
  const StatusOr<FinishedRun> run = ReadFinishedRun(settings.output);
  if (!run.ok()) return run.status();
  const SlamRunView files = ReadSlamRun(*run, settings.input, /*with_truth=*/false);
  return WriteSequenceLook(outputs, run->report, {}, files.view);
}

}  // namespace ceres_ed
