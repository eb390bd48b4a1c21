// ed_eval measures how good a result is: a fitted surface, or the map of a sequence.
#include <ceres_ed/pipeline/evaluate/evaluate_run.h>

#include <string>
#include <vector>

#include <apps/eval_flags.h>
#include <apps/eval_text.h>
#include <apps/support/console.h>
#include <apps/support/program.h>
#include <apps/support/run_flags.h>

namespace ceres_ed {
namespace {

class EvaluateConsole : public ConsoleObserver<EvaluateObserver> {
 public:
  EvaluateConsole() : ConsoleObserver("ed_eval", /*quiet=*/false) {}

  void OnPair(const Evaluation& evaluation) override {
    console().Summarize(EvaluationTable(evaluation));
  }
  void OnCalibration(const CalibrationFigures& calibration) override {
    console().Summarize(CalibrationTable(calibration));
  }
  void OnSequence(const SequenceFigures& figures) override {
    console().Summarize(SequenceTables(figures));
  }
};

Outcome Run(const std::vector<std::string>& arguments) {
  StatusOr<EvalSettings> settings = ReadEvalFlags(arguments);
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  settings->flags = CurrentFlags();
  EvaluateConsole console;
  return RunEvaluation(*settings, &console);
}

const ProgramInfo kProgram = {
    "ed_eval",
    "RESULT TARGET [flags] | --sequence=SEQ --result=DIR [--report=R.json]",
    "Measures how far a fitted surface is from its target, or how well the map that ed_slam made "
    "of a sequence follows the tissue. The map is compared with the truth, the depth images and "
    "tracks_2d.csv, as far as the sequence has them. Sequences are in metres.",
    "ed_eval fitted.ply target.ply --source=source.ply --truth=gt.ply",
    0,
    2};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
