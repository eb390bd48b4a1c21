#include "apps/depth_run.h"

#include <ceres_ed/pipeline/depth/depth_run.h>
#include <ceres_ed/util/options.h>
#include <ceres_ed/util/timer.h>

#include <cmath>
#include <cstdio>

#include <apps/support/console.h>
#include <apps/support/option_flags.h>
#include <apps/support/run_flags.h>

namespace ceres_ed {
namespace {

// The settings on the command line: those of the run, and those of what the program shows.
struct DepthFlags {
  DepthSettings settings;
  bool quiet = false;
};

const OptionTable<DepthSettings>& SettingsRows() {
  using S = DepthSettings;
  static const OptionTable<S> rows({
      Row(&S::output, "output", "Folder to write, created if it does not exist; required.")
          .Letter('o')
          .File(),
      Row(&S::overwrite, "overwrite", "Replace a sequence that is already in --output.").File(),
      Row(&S::units_per_metre,
          "units_per_metre",
          "The depth in metres times this is written; automatic is the finest power of ten that "
          "fits.")
          .In(AtLeast(0))
          .Special(0, "automatic")
          .File(),
      Nested(&S::sequence, SequenceOptions::Rows()),
      Nested(&S::stereo, StereoOptions::Rows()),
  });
  return rows;
}

const OptionTable<DepthFlags>& DepthRows() {
  using C = DepthFlags;
  static const OptionTable<C> rows({
      Nested(&C::settings, SettingsRows()),
      Row(&C::quiet, "quiet", "Show no summary, no notes and no progress bar.").Letter('q').Main(),
  });
  return rows;
}

const OptionFlags<DepthFlags> kFlags(DepthRows());

class DepthConsole : public ConsoleObserver<DepthObserver> {
 public:
  DepthConsole(const DepthFlags& flags, const Timer& clock)
      : ConsoleObserver("ed_depth", flags.quiet), settings_(flags.settings), clock_(clock) {}

  void OnEnd(const WrittenDepth& written) override {
    char line[256];
    std::snprintf(line,
                  sizeof(line),
                  ": %d frames of %d x %d, depth of %.1f %% of the pixels, median %.4g mm, %.1f s",
                  written.frames,
                  written.width,
                  written.height,
                  100.0 * written.valid_share,
                  1e3 * written.depth,
                  clock_.Seconds());
    std::string text = settings_.output + line;
    if (!std::isnan(written.stereo_s)) {
      std::snprintf(line, sizeof(line), " (%.0f ms a pair)", 1e3 * written.stereo_s);
      text += line;
    }
    if (written.skipped > 0) text += ", " + std::to_string(written.skipped) + " frames skipped";
    console().Summarize(text + "\n");
  }

 private:
  const DepthSettings& settings_;
  const Timer& clock_;
};

}  // namespace

Outcome RunDepthProgram(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  StatusOr<DepthFlags> read = kFlags.Read();
  if (!read.ok()) return Outcome::Usage(read.status().message());
  DepthSettings& settings = read->settings;
  if (settings.output.empty()) return Outcome::Usage("flag --output is required");
  settings.input = arguments[0];
  settings.flags = CurrentFlags();
  std::string error;
  if (!settings.sequence.IsValid(&error)) return Outcome::Usage(error);
  if (!settings.stereo.IsValid(&error)) return Outcome::Usage(error);
  DepthConsole console(*read, clock);
  return RunDepth(settings, &console);
}

}  // namespace ceres_ed
