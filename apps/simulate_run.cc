#include "apps/simulate_run.h"

#include <ceres_ed/io/sequence/native_writer.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/simulation/sequences.h>
#include <ceres_ed/util/timer.h>
#include <ceres_ed/version.h>

#include <cstdio>
#include <optional>

#include <apps/support/progress_bar.h>
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

Status WriteInfo(const std::string& scene, const SyntheticSequence& sequence, int frames) {
  nlohmann::ordered_json info = {{"program", "ed_simulate"},
                                 {"version", kVersion},
                                 {"scene", scene},
                                 {"frames", frames},
                                 {"vertices", sequence.truth_mesh().size()},
                                 {"faces", sequence.truth_mesh().triangles.size()},
                                 {"units", "metres in poses and truth"}};
  // Where the files are must not change what is in them.
  nlohmann::ordered_json flags = FlagsReport(CurrentFlags());
  for (const char* name : {"output", "overwrite", "quiet"}) flags.erase(name);
  info["flags"] = flags;
  return WriteReport(FLAGS_output + "/info.json", info);
}

// Writes the frames, until someone asks it to stop.
Status WriteFrames(const SyntheticSequence& sequence, NativeSequenceWriter* writer) {
  ProgressBar bar("ed_simulate", sequence.num_frames(), FLAGS_quiet);
  const Timer clock;
  const bool with_truth = !sequence.truth_mesh().empty();
  for (int k = 0; k < sequence.num_frames() && !StopRequested(); ++k) {
    const SyntheticFrame frame = sequence.Render(k, FLAGS_color);
    std::vector<Eigen::Vector3d> truth;
    if (with_truth) truth = sequence.TruthPoints(k);
    NativeFrame native;
    native.depth = &frame.depth;
    native.color = &frame.color;
    native.mask = &frame.mask;
    native.world_from_camera = frame.world_from_camera;
    native.truth = with_truth ? &truth : nullptr;
    if (Status status = writer->WriteFrame(native); !status.ok()) return status;
    char note[64];
    std::snprintf(note, sizeof(note), "frames, %.1f a second", (k + 1) / clock.Seconds());
    bar.Update(k + 1, note);
  }
  return writer->Finish();
}

}  // namespace

Outcome RunSimulate(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  const std::string& scene = arguments[0];
  const StatusOr<SyntheticSequenceOptions> options = ReadFlags(scene);
  if (!options.ok()) return Outcome::Usage(options.status().message());
  if (!FLAGS_overwrite && HoldsNativeSequence(FLAGS_output)) {
    return Outcome::BadInput(Status::Error(
        FLAGS_output + ": holds a sequence already, expected an empty folder or --overwrite"));
  }
  // Meshing an organ takes seconds.
  std::optional<ProgressBar> bar(std::in_place, "ed_simulate", 1, FLAGS_quiet);
  bar->Update(0, "meshing the tissue");
  const SyntheticSequence sequence(*options);
  bar.reset();
  if (!sequence.truth_note().empty()) {
    std::fprintf(stderr, "ed_simulate: warning: %s\n", sequence.truth_note().c_str());
  }
  NativeSequenceOptions layout;
  layout.camera = {sequence.camera(), sequence.depth_units_per_metre()};
  layout.truth_triangles = sequence.truth_mesh().triangles;
  layout.overwrite = FLAGS_overwrite;
  const auto writer = NativeSequenceWriter::Create(FLAGS_output, layout);
  if (!writer.ok()) return Outcome::BadInput(writer.status());

  Status status = WriteFrames(sequence, writer->get());
  const int frames = (*writer)->num_frames();
  if (status.ok()) status = WriteInfo(scene, sequence, frames);
  if (!status.ok()) return Outcome::BadInput(status);
  if (!FLAGS_quiet) {
    std::printf("%s: %d frames of %s, %d x %d, %zu vertices with truth, %.1f s\n",
                FLAGS_output.c_str(),
                frames,
                scene.c_str(),
                options->width,
                options->height,
                sequence.truth_mesh().size(),
                clock.Seconds());
  }
  if (frames < sequence.num_frames()) {
    return Outcome::StoppedEarly("stopped at frame " + std::to_string(frames) + " of " +
                                 std::to_string(sequence.num_frames()) + "; what is in " +
                                 FLAGS_output + " is whole");
  }
  return Outcome::Done();
}

}  // namespace ceres_ed
