// ed_cohort fits one template to many shapes, many pairs, or tracks many sequences, and joins what
// has been found.
#include <ceres_ed/pipeline/cohort/cohort_run.h>
#include <ceres_ed/util/timer.h>

#include <string>
#include <vector>

#include <apps/cohort_flags.h>
#include <apps/cohort_text.h>
#include <apps/support/console.h>
#include <apps/support/program.h>

namespace ceres_ed {
namespace {

class CohortConsole : public ConsoleObserver<CohortObserver> {
 public:
  explicit CohortConsole(bool quiet) : ConsoleObserver("ed_cohort", quiet) {}

  void OnShard(int run, int skipped, int failed) override {
    console().Summarize(ShardSummary(run, skipped, failed));
  }
  void OnCollected(const CollectedMembers& all, const ShapeStatistics& statistics) override {
    console().Summarize(CohortSummary(all, statistics));
  }
};

Outcome Run(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  StatusOr<CohortCommand> command = ReadCohortFlags();
  if (!command.ok()) return Outcome::Usage(command.status().message());
  CohortConsole console(command->quiet);
  if (command->collect) {
    CollectSettings settings;
    settings.folders = arguments;
    settings.output = command->output;
    settings.model = command->model;
    settings.fail_if = command->fit.fail_if;
    return CollectCohort(settings, &console);
  }
  if (arguments.size() > 1) {
    return Outcome::Usage("'" + arguments[1] + "' is a second argument, expected TEMPLATE alone");
  }
  if (!arguments.empty()) command->source = arguments[0];
  return RunCohort(*command, clock, &console);
}

constexpr int kMaxFolders = 32;

const ProgramInfo kProgram = {
    "ed_cohort",
    "TEMPLATE --manifest=F.csv --output=DIR | --collect DIR [DIR ...]",
    "Fits TEMPLATE to many shapes, several at a time, and makes a summary, correspondences, the "
    "mean, principal components and a test of groups of them. The same command goes on where an "
    "earlier run has ended. --pairs and --sequences are run in the same way, without statistics.",
    "ed_cohort template.ply --manifest=shapes.csv --output=cohort",
    0,
    kMaxFolders};

}  // namespace
}  // namespace ceres_ed

int main(int argc, char** argv) {
  return ceres_ed::RunProgram(ceres_ed::kProgram, argc, argv, ceres_ed::Run);
}
