#include "apps/cohort_flags.h"

#include <ceres_ed/pipeline/cohort/manifest.h>
#include <ceres_ed/pipeline/fit/scale_setting.h>
#include <ceres_ed/util/options.h>

#include <set>
#include <utility>
#include <vector>

#include <apps/support/option_flags.h>
#include <apps/support/run_flags.h>

namespace ceres_ed {
namespace {

// The settings in the flags, with the energies and the shard as text.
struct CohortFlags {
  CohortSettings settings;
  std::string shard;
  std::string energy;
  bool collect = false;
  bool quiet = false;
};

// Returns rows of which --help shows none, but --help=all all.
OptionRows<FitSettings> ForExperts(const OptionRows<FitSettings>& rows) {
  std::vector<OptionRows<FitSettings>::OneRow> changed = rows.rows();
  for (auto& row : changed) {
    if (row.option.group == OptionGroup::kMain) row.option.group = OptionGroup::kExpert;
  }
  return OptionRows<FitSettings>(changed);
}

// The settings of each fit.
const OptionTable<FitSettings>& FitRows() {
  using S = FitSettings;
  static const OptionTable<S> rows({
      Row(&S::source_landmarks,
          "source_landmarks",
          "Named points on TEMPLATE to read: .mrk.json, .fcsv, .json, .pts, .csv.")
          .File(),
      Row(&S::landmark_use, "landmark_use", "Named points draw the fits, or measure them.").Main(),
      Row(&S::mesh_space,
          "mesh_space",
          "The axes of the meshes, into which named points in RAS or LPS are turned. auto: what a "
          "mesh file says, otherwise LPS."),
      Row(&S::fixed, "fixed", "Text to read: indices of TEMPLATE's points that must not move.")
          .File(),
      Row(&S::plugin, "plugin", "Shared object with more energies, or several, separated by ';'.")
          .File(),
      Row(&S::scale,
          "scale",
          "A factor for TEMPLATE: a number, auto, or units such as mm:m. A unit in the table goes "
          "first."),
      Row(&S::repair, "repair", "Mend what ed_check finds and what is safe to mend."),
      Row(&S::fail_if, "fail_if", "Exit code 3 from this verdict of any member.").Main(),
      ForExperts(
          Nested(&S::options, FitOptions::Rows()).Internal("covariance").Internal("threads")),
  });
  return rows;
}

const OptionTable<ModelSettings>& ModelRows() {
  using S = ModelSettings;
  static const OptionTable<S> rows({
      Row(&S::align,
          "align",
          "What is taken out before the statistics: position, rotation and size; all but the size; "
          "nothing.")
          .Main(),
      Row(&S::components, "components", "The most principal components.").In(AtLeast(1)).Main(),
      Row(&S::permutations, "permutations", "The random assignments of the test of groups.")
          .In(AtLeast(1))
          .Main(),
      Row(&S::worst, "worst", "The worst verdict with which a shape is part of the mean.").Main(),
  });
  return rows;
}

const OptionTable<CohortSettings>& SettingsRows() {
  using S = CohortSettings;
  static const OptionTable<S> rows({
      Row(&S::output, "output", "Folder to write; required except with --collect.")
          .Letter('o')
          .File(),
      Row(&S::manifest,
          "manifest",
          "CSV to read with columns path, and name, landmarks, unit, group as far as they are "
          "given; or a folder of shapes.")
          .File(),
      Row(&S::pairs,
          "pairs",
          "CSV to read in place of TEMPLATE and --manifest, with columns source, target, and name, "
          "group, source_landmarks, target_landmarks.")
          .File(),
      Row(&S::sequences,
          "sequences",
          "CSV to read with columns path, and name, group; or a folder of sequences: each is "
          "tracked as ed_slam does.")
          .File(),
      Row(&S::unit, "unit", "The unit of TEMPLATE, if the table has units: um, mm, cm, in or m.")
          .Main(),
      Row(&S::jobs, "jobs", "The members that are run at a time. 0 = one for each core.")
          .In(AtLeast(0))
          .Special(0, "cores")
          .Main(),
      Row(&S::memory_mb, "memory_mb", "The memory of all members at work. 0 = unlimited.")
          .In(AtLeast(0))
          .Unit("MB")
          .Special(0, "unlimited")
          .Main(),
      Row(&S::resume, "resume", "Skip what is done with the same inputs and flags.").Main(),
      Row(&S::retry_failed, "retry_failed", "Run again what has failed before.").Main(),
      Row(&S::iterate, "iterate", "How often the mean becomes the template.")
          .In(Between(0, 100))
          .Main(),
      Row(&S::pages, "pages", "Write a page and a small picture of each fit.").Main(),
      Row(&S::warps, "warps", "Write warp.json of each fit, for ed_apply.").Main(),
      Nested(&S::model, ModelRows()),
      Nested(&S::fit, FitRows()),
      NotData(&S::source),
      NotData(&S::shard),
      NotData(&S::slam),
  });
  return rows;
}

const OptionTable<CohortFlags>& CohortFlagsRows() {
  using C = CohortFlags;
  static const OptionTable<C> rows({
      Nested(&C::settings, SettingsRows()),
      Row(&C::shard, "shard", "Run only every n-th member, from number i on: i/n.").Main(),
      Row(&C::collect, "collect", "Run nothing; join the finished members in folders DIR.").Main(),
      Row(&C::energy,
          "energy",
          "More energies: NAME[:param=value,...];... (see ed_list_energies)."),
      Row(&C::quiet, "quiet", "Show no summary and no progress bar.").Letter('q').Main(),
  });
  return rows;
}

const OptionFlags<CohortFlags> kFlags(CohortFlagsRows());

// Returns the flags on which the result of a member depends: all but those that say which members
// are run, how, and what is made of them afterwards. Files are compared by their contents.
RunFlags FlagsOfMembers() {
  static const std::set<std::string> kOthers = {
      "output", "manifest", "pairs", "sequences",        "unit",         "jobs",   "memory_mb",
      "resume", "iterate",  "align", "components",       "permutations", "worst",  "retry_failed",
      "shard",  "collect",  "quiet", "source_landmarks", "fixed",        "fail_if"};
  RunFlags flags;
  for (RunFlag& flag : CurrentFlags()) {
    if (kOthers.count(flag.name) == 0) flags.push_back(std::move(flag));
  }
  return flags;
}

}  // namespace

StatusOr<CohortCommand> ReadCohortFlags() {
  StatusOr<CohortFlags> read = kFlags.Read();
  if (!read.ok()) return read.status();
  CohortCommand command;
  static_cast<CohortSettings&>(command) = std::move(read->settings);
  command.collect = read->collect;
  command.quiet = read->quiet;
  if (command.output.empty() && !command.collect) {
    return Status::Error("flag --output is required");
  }
  StatusOr<Shard> shard = ParseShard(read->shard);
  if (!shard.ok()) return shard.status();
  command.shard = *shard;
  FitSettings& fit = command.fit;
  if (const auto scale = ParseScale(fit.scale); !scale.ok()) return scale.status();
  if (!command.unit.empty() && !ParseScale(command.unit + ":mm").ok()) {
    return Status::Error("--unit=" + command.unit + ", expected um, mm, cm, in or m");
  }
  StatusOr<std::vector<EnergySpec>> energies = ParseEnergySpecs(read->energy);
  if (!energies.ok()) return Status::Error("--energy: " + energies.status().message());
  fit.options.extra_energies = *std::move(energies);
  std::string error;
  if (!fit.options.IsValid(&error)) return Status::Error(error);
  fit.flags = FlagsOfMembers();
  return command;
}

}  // namespace ceres_ed
