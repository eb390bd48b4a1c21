#include "apps/simulate_run.h"

#include <ceres_ed/pipeline/simulate/simulate_run.h>
#include <ceres_ed/simulation/sequences.h>
#include <ceres_ed/util/timer.h>

#include <cstdio>
#include <optional>

#include <apps/support/console.h>
#include <apps/support/run_flags.h>
#include <gflags/gflags.h>

DEFINE_string(output, "", "folder to write the sequence to, made if it is not there; required");
DEFINE_bool(overwrite, false, "replace a sequence that is in --output already");
DEFINE_int32(frames, 0, "frames; 0: 60 for an organ, 10 for plane, by its length for strip");
DEFINE_int32(nodes_hint,
             0,
             "strip only: its length is N / 300 views, so that a map with 300 nodes in view ends "
             "with N nodes; 0: by --frames, or 1000");
DEFINE_int32(width, 640, "columns of the pictures; the field of view is 59.5 degrees at any width");
DEFINE_int32(height, 480, "rows of the pictures");
DEFINE_double(noise,
              0.25e-3,
              "deviation of the depth seen straight on, metres; it grows toward grazing angles, "
              "where pixels drop out; 0: exact to 0.1 mm, the unit of the pictures");
DEFINE_double(period, 25.0, "frames in which the tissue moves there and back");
DEFINE_int32(vertices,
             0,
             "of the tissue's mesh; not for strip, which has one every 1.5 mm; 0: 12000");
DEFINE_uint64(seed, 1, "of texture and noise");
DEFINE_bool(color, true, "write color/ too");
DEFINE_bool(truth, true, "write every vertex's truth (gt_vertices.f32) too; poses always are");
DEFINE_bool(quiet, false, "no progress bar and no summary");

namespace ceres_ed {
namespace {

StatusOr<SyntheticSequenceOptions> ReadFlags(const std::string& scene) {
  if (FLAGS_output.empty()) return Status::Error("flag --output is required");
  const std::optional<SyntheticSceneKind> kind = SyntheticSceneFromName(scene);
  if (!kind.has_value()) {
    std::string known;
    for (const SyntheticSceneKind k : AllSyntheticSceneKinds()) {
      known += (known.empty() ? "" : ", ") + std::string(SyntheticSceneName(k));
    }
    return Status::Error("unknown scene '" + scene + "', expected one of " + known);
  }
  SyntheticSequenceOptions options;
  options.kind = *kind;
  options.frames = FLAGS_frames;
  options.nodes_hint = FLAGS_nodes_hint;
  options.width = FLAGS_width;
  options.height = FLAGS_height;
  options.seed = FLAGS_seed;
  options.noise = FLAGS_noise;
  options.period = FLAGS_period;
  options.vertices = FLAGS_vertices;
  options.truth = FLAGS_truth;
  // 0 stands for "not given" only.
  gflags::CommandLineFlagInfo frames;
  gflags::GetCommandLineFlagInfo("frames", &frames);
  if (!frames.is_default && FLAGS_frames < 1) {
    return Status::Error("--frames=" + frames.current_value + ", expected 1 or more");
  }
  std::string error;
  if (!options.IsValid(&error)) return Status::Error(scene + ": " + error);
  return options;
}

class SimulateConsole : public ConsoleObserver<SimulateObserver> {
 public:
  SimulateConsole(const SimulateSettings& settings, const Timer& clock)
      : ConsoleObserver("ed_simulate", FLAGS_quiet), settings_(settings), clock_(clock) {}

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
  const StatusOr<SyntheticSequenceOptions> options = ReadFlags(arguments[0]);
  if (!options.ok()) return Outcome::Usage(options.status().message());
  SimulateSettings settings;
  settings.options = *options;
  settings.scene = arguments[0];
  settings.output = FLAGS_output;
  settings.overwrite = FLAGS_overwrite;
  settings.color = FLAGS_color;
  settings.flags = CurrentFlags();
  SimulateConsole console(settings, clock);
  return RunSimulation(settings, &console);
}

}  // namespace ceres_ed
