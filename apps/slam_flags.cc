#include "apps/slam_flags.h"

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <apps/support/choices.h>
#include <apps/support/command_line.h>
#include <gflags/gflags.h>

namespace ceres_ed {
namespace {

constexpr Choice<SolveMode> kModes[] = {{"two_level", SolveMode::kTwoLevel},
                                        {"batch", SolveMode::kBatch},
                                        {"marginal", SolveMode::kMarginal}};
constexpr Choice<SeamEdges> kBoundaries[] = {{"keep", SeamEdges::kKeep}, {"cut", SeamEdges::kCut}};
constexpr Choice<LevelTwoMode> kLevelTwos[] = {{"full", LevelTwoMode::kFull},
                                               {"lazy", LevelTwoMode::kLazy}};
constexpr Choice<CameraMode> kCameras[] = {{"estimate", CameraMode::kEstimate},
                                           {"fixed", CameraMode::kFixed},
                                           {"given", CameraMode::kGiven}};
constexpr Choice<bool> kFeatures[] = {{"auto", true}, {"none", false}};
constexpr Choice<ProgressStyle> kProgress[] = {
    {"bar", ProgressStyle::kBar}, {"json", ProgressStyle::kJson}, {"none", ProgressStyle::kNone}};

// On the command line 0 stands for no limit.
constexpr double kNoLimit = 0.0;

const SlamCommand& Defaults() {
  static const SlamCommand defaults;
  return defaults;
}

}  // namespace
}  // namespace ceres_ed

using ceres_ed::Defaults;
using ceres_ed::NameOf;

DEFINE_string(output, "", "folder to write; required");
DEFINE_string(
    mode,
    NameOf(ceres_ed::kModes, Defaults().options.levels.strategy.mode),
    "two_level: nodes in view, then the rest; batch: all; marginal: as batch, from those in view");
DEFINE_int32(rings,
             Defaults().options.levels.strategy.rings,
             "rings of hidden nodes that level I moves too");
DEFINE_string(boundary,
              NameOf(ceres_ed::kBoundaries, Defaults().options.levels.strategy.seam_edges),
              "two_level: keep or cut edges across the seam of level I");
DEFINE_string(level2,
              NameOf(ceres_ed::kLevelTwos, Defaults().options.levels.level_two),
              "two_level: lazy: the rest moves when it has reason to; full: in every frame");
DEFINE_int32(verify_every,
             Defaults().options.verify_every,
             "hold every n-th frame against the batch solve, on a copy; 0 = none");
DEFINE_string(camera,
              NameOf(ceres_ed::kCameras, Defaults().options.camera),
              "estimate; fixed: it never moves; given: as the sequence says");
DEFINE_string(format,
              ceres_ed::SequenceFormatName(Defaults().sequence.format),
              "of the sequence: auto native tum hamlyn");
DEFINE_int32(first, Defaults().sequence.first, "number of the first frame");
DEFINE_int32(last, Defaults().sequence.last, "number of the last frame; -1 = to the end");
DEFINE_int32(step, Defaults().sequence.step, "take every n-th frame");
DEFINE_string(track, "", "PLY of points to follow: first frame's camera, metres; into tracks.csv");
DEFINE_int32(live_every, Defaults().live_every, "write every n-th live cloud; 0 = none");
DEFINE_int32(checkpoint_every,
             Defaults().checkpoint_every,
             "frames between checkpoints; 0 = only the results, at the end");
DEFINE_bool(resume, Defaults().resume, "go on from the last checkpoint in --output");
DEFINE_string(features,
              NameOf(ceres_ed::kFeatures, Defaults().options.features),
              "auto: follow corners of the colour images; none");
DEFINE_double(node_spacing,
              Defaults().options.node_spacing,
              "distance of nodes, metres; 0 = from --nodes_in_view");
DEFINE_int32(nodes_in_view,
             Defaults().options.nodes_in_view,
             "about so many nodes cover what the first frame shows");
DEFINE_double(w_rot, Defaults().options.levels.rotation_weight, "weight of E_rot: near a rotation");
DEFINE_double(w_reg,
              Defaults().options.levels.regularization_weight,
              "weight of E_reg: neighbours agree");
DEFINE_double(w_data,
              Defaults().options.levels.plane_weight,
              "weight of the distance to the depth");
DEFINE_int32(max_observations,
             Defaults().options.max_observations,
             "points of the map that are held against a frame");
DEFINE_string(energy, "", "more energies, NAME[:param=value,...];... (see ed_list_energies)");
DEFINE_string(plugin, "", "shared object with more energies; several with ; between them");
DEFINE_int32(threads, Defaults().options.num_threads, "changes the time, not the result");
DEFINE_double(time_limit_s, ceres_ed::kNoLimit, "seconds until it stops, exit code 4; 0 = none");
DEFINE_string(progress,
              NameOf(ceres_ed::kProgress, Defaults().progress),
              "bar: on a terminal; json: an object a frame on stdout; none");
DEFINE_bool(quiet, Defaults().quiet, "no summary, no progress bar, no word on the sequence");

namespace ceres_ed {
namespace {

struct Range {
  const char* flag;
  double value;
  double lowest;
  const char* expected;
};

Status CheckNumbers() {
  const Range ranges[] = {
      {"rings", FLAGS_rings * 1.0, 0.0, "a whole number >= 0"},
      {"first", FLAGS_first * 1.0, 0.0, "a frame number >= 0"},
      {"last", FLAGS_last * 1.0, -1.0, "a frame number, or -1 for the end"},
      {"step", FLAGS_step * 1.0, 1.0, "a whole number >= 1"},
      {"live_every", FLAGS_live_every * 1.0, 0.0, "a whole number >= 0 (0 = none)"},
      {"checkpoint_every", FLAGS_checkpoint_every * 1.0, 0.0, "a whole number >= 0 (0 = none)"},
      {"nodes_in_view", FLAGS_nodes_in_view * 1.0, 4.0, "a whole number >= 4"},
      {"max_observations", FLAGS_max_observations * 1.0, 100.0, "a whole number >= 100"},
      {"verify_every", FLAGS_verify_every * 1.0, 0.0, "a whole number >= 0 (0 = none)"},
      {"threads", FLAGS_threads * 1.0, 1.0, "a whole number >= 1"},
      {"node_spacing", FLAGS_node_spacing, 0.0, "metres >= 0 (0 = automatic)"},
      {"w_rot", FLAGS_w_rot, 0.0, "a finite number >= 0"},
      {"w_reg", FLAGS_w_reg, 0.0, "a finite number >= 0"},
      {"w_data", FLAGS_w_data, 0.0, "a finite number >= 0"},
      {"time_limit_s", FLAGS_time_limit_s, 0.0, "seconds >= 0 (0 = no limit)"}};
  for (const Range& range : ranges) {
    if (std::isfinite(range.value) && range.value >= range.lowest) continue;
    return Status::Error("--" + std::string(range.flag) + "=" + CurrentValue(range.flag) +
                         ", expected " + range.expected);
  }
  return Status::Ok();
}

Status ReadChoices(SlamCommand* settings) {
  SlamOptions* options = &settings->options;
  Status status = Choose("mode", kModes, FLAGS_mode, &options->levels.strategy.mode);
  if (!status.ok()) return status;
  status = Choose("boundary", kBoundaries, FLAGS_boundary, &options->levels.strategy.seam_edges);
  if (!status.ok()) return status;
  status = Choose("level2", kLevelTwos, FLAGS_level2, &options->levels.level_two);
  if (!status.ok()) return status;
  status = Choose("camera", kCameras, FLAGS_camera, &options->camera);
  if (!status.ok()) return status;
  status = Choose("features", kFeatures, FLAGS_features, &options->features);
  if (!status.ok()) return status;
  status = Choose("progress", kProgress, FLAGS_progress, &settings->progress);
  if (!status.ok()) return status;
  const StatusOr<SequenceFormat> format = ParseSequenceFormat(FLAGS_format);
  if (!format.ok()) return Status::Error("--format: " + format.status().message());
  settings->sequence.format = *format;
  StatusOr<std::vector<EnergySpec>> energies = ParseEnergySpecs(FLAGS_energy);
  if (!energies.ok()) return Status::Error("--energy: " + energies.status().message());
  options->levels.energies = *std::move(energies);
  return Status::Ok();
}

void ReadNumbers(SlamSettings* settings) {
  SlamOptions* options = &settings->options;
  options->levels.strategy.rings = FLAGS_rings;
  options->node_spacing = FLAGS_node_spacing;
  options->nodes_in_view = FLAGS_nodes_in_view;
  options->levels.rotation_weight = FLAGS_w_rot;
  options->levels.regularization_weight = FLAGS_w_reg;
  options->levels.plane_weight = FLAGS_w_data;
  options->max_observations = FLAGS_max_observations;
  options->verify_every = FLAGS_verify_every;
  options->num_threads = FLAGS_threads;
  options->surface.num_threads = FLAGS_threads;
  options->feature.pixels.num_threads = FLAGS_threads;
  settings->sequence.first = FLAGS_first;
  settings->sequence.last = FLAGS_last;
  settings->sequence.step = FLAGS_step;
  settings->live_every = FLAGS_live_every;
  settings->checkpoint_every = FLAGS_checkpoint_every;
  settings->time_limit_s =
      FLAGS_time_limit_s > 0.0 ? FLAGS_time_limit_s : std::numeric_limits<double>::infinity();
}

}  // namespace

StatusOr<SlamCommand> ReadSlamFlags() {
  SlamCommand settings;
  if (FLAGS_output.empty()) return Status::Error("flag --output is required");
  settings.output = FLAGS_output;
  settings.track = FLAGS_track;
  settings.plugin = FLAGS_plugin;
  settings.resume = FLAGS_resume;
  settings.quiet = FLAGS_quiet;
  if (Status status = CheckNumbers(); !status.ok()) return status;
  if (Status status = ReadChoices(&settings); !status.ok()) return status;
  ReadNumbers(&settings);
  std::string error;
  if (!settings.sequence.IsValid(&error)) return Status::Error(error);
  return settings;
}

namespace {

// Flags of which `wanted(name)`, a line each.
template <typename Wanted>
std::string FlagLines(Wanted wanted) {
  std::string lines;
  for (const auto& flag : OwnFlags()) {
    if (wanted(flag.name)) lines += "--" + flag.name + "=" + CurrentValue(flag.name) + "\n";
  }
  return lines;
}

// How the levels are solved: a run may go on another way.
const std::set<std::string>& StrategyNames() {
  static const std::set<std::string> names = {"mode", "rings", "boundary", "level2"};
  return names;
}

}  // namespace

std::string FixedFlags() {
  const std::set<std::string> free = {"output",
                                      "overwrite",
                                      "resume",
                                      "threads",
                                      "time_limit_s",
                                      "progress",
                                      "quiet",
                                      "last",
                                      "checkpoint_every",
                                      "verify_every"};
  return FlagLines([&free](const std::string& name) {
    return free.count(name) == 0 && StrategyNames().count(name) == 0;
  });
}

std::string StrategyFlags() {
  return FlagLines([](const std::string& name) { return StrategyNames().count(name) > 0; });
}

}  // namespace ceres_ed
