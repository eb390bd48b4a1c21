#include "ceres_ed/pipeline/simulate/simulate_run.h"

#include <ceres_ed/io/sequence/native_writer.h>
#include <ceres_ed/io/sequence/sequence_writer.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/util/timer.h>
#include <ceres_ed/version.h>

#include <cstdio>
#include <vector>

namespace ceres_ed {
namespace {

Status WriteInfo(const SimulateSettings& settings, const SyntheticSequence& sequence, int frames) {
  nlohmann::ordered_json info = {{"program", "ed_simulate"},
                                 {"version", kVersion},
                                 {"scene", settings.scene},
                                 {"frames", frames},
                                 {"vertices", sequence.truth_mesh().size()},
                                 {"faces", sequence.truth_mesh().triangles.size()},
                                 {"units", "metres in poses and truth"}};
  nlohmann::ordered_json flags = FlagsReport(settings.flags);
  for (const char* name : {"output", "overwrite", "quiet"}) flags.erase(name);
  info["flags"] = flags;
  return WriteReport(settings.output + "/info.json", info);
}

// Writes the frames until the observer asks to stop.
Status WriteFrames(const SyntheticSequence& sequence,
                   bool color,
                   SequenceWriter* writer,
                   RunObserver* observer) {
  const Timer clock;
  const bool with_truth = !sequence.truth_mesh().empty();
  for (int k = 0; k < sequence.num_frames() && !observer->ShouldStop(); ++k) {
    const SyntheticFrame frame = sequence.Render(k, color);
    std::vector<Eigen::Vector3d> truth;
    if (with_truth) truth = sequence.TruthPoints(k);
    FrameToWrite native;
    native.depth = &frame.depth;
    native.color = &frame.color;
    native.right = &frame.right;
    native.mask = &frame.mask;
    native.world_from_camera = frame.world_from_camera;
    native.truth = with_truth ? &truth : nullptr;
    if (Status status = writer->WriteFrame(native); !status.ok()) return status;
    char note[64];
    std::snprintf(note, sizeof(note), "frames, %.1f a second", (k + 1) / clock.Seconds());
    observer->OnProgress(k + 1, sequence.num_frames(), note);
  }
  return writer->Close();
}

}  // namespace

Outcome RunSimulation(const SimulateSettings& settings, SimulateObserver* observer) {
  const bool is_stereo = settings.options.stereo;
  const SequenceLayout* const format = FindSequenceLayout(settings.layout, is_stereo);
  if (format == nullptr) {
    return Outcome::Usage("--layout=" + NameOf(settings.layout) + " can't be written " +
                          (is_stereo ? "with" : "without") + " --stereo, expected one of " +
                          ListSequenceLayouts(is_stereo, ", "));
  }
  if (!settings.overwrite && HoldsNativeSequence(settings.output)) {
    return Outcome::BadInput(Status::Error(
        settings.output + ": holds a sequence already, expected an empty folder or --overwrite"));
  }
  // The progress is shown before the tissue is meshed, which takes seconds for an organ.
  observer->OnProgress(0, 1, "meshing the tissue");
  const SyntheticSequence sequence(settings.options);
  if (!sequence.truth_note().empty()) observer->OnWarning(sequence.truth_note());
  SequenceWriterOptions layout;
  layout.rig = sequence.rig();
  layout.camera = {sequence.camera(), sequence.depth_units_per_metre()};
  layout.truth_triangles = sequence.truth_mesh().triangles;
  layout.overwrite = settings.overwrite;
  const auto writer = format->create(settings.output, layout);
  if (!writer.ok()) return Outcome::BadInput(writer.status());

  Status status = WriteFrames(sequence, settings.color, writer->get(), observer);
  const int frames = (*writer)->num_frames();
  if (status.ok()) status = WriteInfo(settings, sequence, frames);
  if (!status.ok()) return Outcome::BadInput(status);
  observer->OnEnd({frames, sequence.truth_mesh().size()});
  if (frames < sequence.num_frames()) {
    return Outcome::StoppedEarly("stopped at frame " + std::to_string(frames) + " of " +
                                 std::to_string(sequence.num_frames()) + "; the frames in " +
                                 settings.output + " are complete");
  }
  return Outcome::Done();
}

}  // namespace ceres_ed
