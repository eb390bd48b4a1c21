#include "apps/simulate_run.h"

#include <ceres_ed/pipeline/simulate/simulate_run.h>
#include <ceres_ed/simulation/sequences.h>
#include <ceres_ed/util/options.h>
#include <ceres_ed/util/timer.h>

#include <cstdio>
#include <cstdlib>
#include <optional>

#include <apps/support/console.h>
#include <apps/support/option_flags.h>
#include <apps/support/run_flags.h>
#include <gflags/gflags.h>

namespace ceres_ed {
namespace {

// The settings on the command line: those of the run, and those of what the program shows.
struct SimulateFlags {
  SimulateSettings settings;
  bool quiet = false;
};

const OptionTable<SimulateSettings>& SettingsRows() {
  using S = SimulateSettings;
  static const OptionTable<S> rows({
      Row(&S::output, "output", "Folder to write, created if it does not exist; required.")
          .Letter('o')
          .File(),
      Row(&S::overwrite, "overwrite", "Replace a sequence that is already in --output.").File(),
      Row(&S::layout, "layout", "The layout to write; auto is the native one.").File(),
      Row(&S::color, "color", "Also write colour pictures (color/).").File(),
      Nested(&S::options, SyntheticSequenceOptions::Rows()),
  });
  return rows;
}

const OptionTable<SimulateFlags>& SimulateRows() {
  using C = SimulateFlags;
  static const OptionTable<C> rows({
      Nested(&C::settings, SettingsRows()),
      Row(&C::quiet, "quiet", "Show no summary and no progress bar.").Letter('q').Main(),
  });
  return rows;
}

const OptionFlags<SimulateFlags> kFlags(SimulateRows());

StatusOr<SimulateFlags> ReadFlags(const std::string& scene) {
  const std::optional<SyntheticSceneKind> kind = FindByName<SyntheticSceneKind>(scene);
  if (!kind.has_value()) {
    return Status::Error("unknown scene '" + scene + "', expected one of " +
                         ListNames<SyntheticSceneKind>(", "));
  }
  // 0 is only the default, which means that the flag is not given.
  const auto frames = gflags::GetCommandLineFlagInfoOrDie("frames");
  if (!frames.is_default && std::atoi(frames.current_value.c_str()) < 1) {
    return Status::Error("--frames=" + frames.current_value + ", expected 1 or more");
  }
  StatusOr<SimulateFlags> read = kFlags.Read();
  if (!read.ok()) return read;
  SimulateSettings& settings = read->settings;
  if (settings.output.empty()) return Status::Error("flag --output is required");
  settings.scene = scene;
  settings.options.kind = *kind;
  settings.flags = CurrentFlags();
  std::string error;
  if (!settings.options.IsValid(&error)) return Status::Error(scene + ": " + error);
  return read;
}

class SimulateConsole : public ConsoleObserver<SimulateObserver> {
 public:
  SimulateConsole(const SimulateFlags& flags, const Timer& clock)
      : ConsoleObserver("ed_simulate", flags.quiet), settings_(flags.settings), clock_(clock) {}

  void OnEnd(const SimulatedSequence& sequence) override {
    char line[512];
    std::snprintf(line,
                  sizeof(line),
                  ": %d frames of %s, %d x %d, %zu vertices with truth, %.1f s\n",
                  sequence.frames,
                  settings_.scene.c_str(),
                  settings_.options.width,
                  settings_.options.height,
                  sequence.truth_vertices,
                  clock_.Seconds());
    console().Summarize(settings_.output + line);
  }

 private:
  const SimulateSettings& settings_;
  const Timer& clock_;
};

}  // namespace

Outcome RunSimulate(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  const StatusOr<SimulateFlags> read = ReadFlags(arguments[0]);
  if (!read.ok()) return Outcome::Usage(read.status().message());
  SimulateConsole console(*read, clock);
  return RunSimulation(read->settings, &console);
}

}  // namespace ceres_ed
