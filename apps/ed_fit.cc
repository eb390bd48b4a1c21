// ed_fit deforms one surface so that it lies on another, or so that its landmarks reach their
// positions.
#include <ceres_ed/pipeline/fit/fit_run.h>
#include <ceres_ed/util/timer.h>

#include <string>
#include <vector>

#include <apps/fit_flags.h>
#include <apps/fit_text.h>
#include <apps/support/console.h>
#include <apps/support/program.h>
#include <apps/support/run_flags.h>

namespace ceres_ed {
namespace {

class FitConsole : public ConsoleObserver<FitObserver> {
 public:
  explicit FitConsole(bool quiet) : ConsoleObserver("ed_fit", quiet) {}

  void OnEnd(const FitRun& run) override { console().Summarize(FitSummary(run)); }
};

Outcome Run(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  StatusOr<FitCommand> command = ReadFitFlags();
  if (!command.ok()) return Outcome::Usage(command.status().message());
  command->source = arguments[0];
  if (arguments.size() > 1) command->target = arguments[1];
  command->flags = CurrentFlags();
  FitConsole console(command->quiet);
  return RunFit(*command, clock, &console);
}

const ProgramInfo kProgram = {
    "ed_fit",
    "SOURCE [TARGET] --output=OUT",
    "Deforms SOURCE so that it lies on TARGET or, without TARGET, so that its landmarks reach "
    "their "
    "positions. Both are meshes or bare points, in one unit: PLY, STL, OBJ, OFF, VTK, VTP, GLB or "
    "PCD.",
    "ed_fit source.ply target.ply --output=fitted.ply --warp=warp.json --report=report.json",
    1,
    2};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
