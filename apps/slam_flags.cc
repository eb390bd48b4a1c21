#include "apps/slam_flags.h"

#include <ceres_ed/util/options.h>

#include <limits>
#include <utility>
#include <vector>

#include <apps/support/command_line.h>
#include <apps/support/option_flags.h>

namespace ceres_ed {
namespace {

// The settings in the flags, with the energies as text.
struct SlamFlags {
  SlamSettings settings;
  ProgressStyle progress = ProgressStyle::kBar;
  bool quiet = false;
  std::string energy;
};

const OptionTable<SlamSettings>& SlamSettingsRows() {
  using S = SlamSettings;
  static const OptionTable<S> rows({
      Row(&S::output, "output", "Folder to write; required.")
          .Letter('o')
          .OnResume(ResumeRule::kFree)
          .File(),
      Row(&S::html, "html", "HTML to write: the run to look at in a browser.")
          .OnResume(ResumeRule::kFree)
          .File(),
      Row(&S::png, "png", "PNG to write: some frames of it as a picture.")
          .OnResume(ResumeRule::kFree)
          .File(),
      Row(&S::mesh, "mesh", "Mesh to write: the map as a surface, with its colours (needs PCL).")
          .OnResume(ResumeRule::kFree)
          .File(),
      Row(&S::theme, "theme", "The ground of --png.").OnResume(ResumeRule::kFree),
      Row(&S::track,
          "track",
          "PLY to read: points to follow, in metres in the first frame's camera; see tracks.csv.")
          .File(),
      Row(&S::predict, "predict", "Follow the points that a challenge gives, and write its files."),
      Row(&S::plugin, "plugin", "Shared object with more energies, or several, separated by ';'.")
          .File(),
      Row(&S::live_every, "live_every", "Write a live cloud every n frames.")
          .In(AtLeast(0))
          .Special(0, "none")
          .File(),
      Row(&S::write_masks,
          "write_masks",
          "Write for each frame in masks/ which pixels are tissue (255), and where a tool or "
          "nothing was seen (0)."),
      Row(&S::checkpoint_every, "checkpoint_every", "Save state, map and report every n frames.")
          .In(AtLeast(0))
          .Special(0, "none")
          .OnResume(ResumeRule::kFree)
          .File(),
      Row(&S::resume, "resume", "Continue from the last checkpoint in --output.")
          .OnResume(ResumeRule::kFree)
          .File(),
      Row(&S::overwrite, "overwrite", "Replace a finished result that is in --output.")
          .OnResume(ResumeRule::kFree)
          .File(),
      Row(&S::time_limit_s, "time_limit_s", "Stop after this time, with exit code 4.")
          .In(AboveOrInfinite(0))
          .Unit("seconds")
          .Special(0, std::numeric_limits<double>::infinity(), "none")
          .OnResume(ResumeRule::kFree)
          .Main(),
      Nested(&S::sequence, SequenceOptions::Rows()),
      Nested(&S::stereo, StereoOptions::Rows(), "stereo_").Group(OptionGroup::kExpert),
      Nested(&S::options, SlamOptions::Rows()),
  });
  return rows;
}

const OptionTable<SlamFlags>& SlamFlagsRows() {
  using C = SlamFlags;
  static const OptionTable<C> rows({
      Row(&C::progress,
          "progress",
          "What is shown during the run: a bar on a terminal, or a JSON object for each frame on "
          "stdout.")
          .OnResume(ResumeRule::kFree)
          .Main(),
      Row(&C::quiet, "quiet", "Show no summary, no progress bar and no notes.")
          .Letter('q')
          .OnResume(ResumeRule::kFree)
          .Main(),
      Nested(&C::settings, SlamSettingsRows()),
      Row(&C::energy, "energy", "More energies: NAME[:param=value,...];... (see ed_list_energies).")
          .Main(),
  });
  return rows;
}

const OptionFlags<SlamFlags> kFlags(SlamFlagsRows());

// Returns the flags with this rule, one line for each.
std::string FlagLines(ResumeRule rule) {
  std::string lines;
  for (const auto& info : OwnFlags()) {
    const OptionFlag* flag = FindOptionFlag(info.name);
    if (flag->option->resume != rule) continue;
    lines += "--" + info.name + "=" + CurrentValue(info.name) + "\n";
  }
  return lines;
}

}  // namespace

StatusOr<SlamCommand> ReadSlamFlags() {
  StatusOr<SlamFlags> read = kFlags.Read();
  if (!read.ok()) return read.status();
  SlamCommand command;
  static_cast<SlamSettings&>(command) = std::move(read->settings);
  command.progress = read->progress;
  command.quiet = read->quiet;
  if (command.output.empty()) return Status::Error("flag --output is required");
  StatusOr<std::vector<EnergySpec>> energies = ParseEnergySpecs(read->energy);
  if (!energies.ok()) return Status::Error("--energy: " + energies.status().message());
  command.options.levels.energies = *std::move(energies);
  std::string error;
  if (!command.sequence.IsValid(&error)) return Status::Error(error);
  if (!command.stereo.IsValid(&error)) return Status::Error("stereo_" + error);
  if (!command.options.IsValid(&error)) return Status::Error(error);
  return command;
}

std::string FixedFlags() { return FlagLines(ResumeRule::kKeep); }

std::string StrategyFlags() { return FlagLines(ResumeRule::kNoted); }

}  // namespace ceres_ed
