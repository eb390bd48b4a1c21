#include "ceres_ed/pipeline/slam/slam_run.h"

#include <ceres_ed/energy/energy_registry.h>
#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/pipeline/outputs.h>
#include <ceres_ed/pipeline/slam/challenge.h>
#include <ceres_ed/pipeline/slam/map_mesh.h>
#include <ceres_ed/pipeline/slam/slam_look.h>
#include <ceres_ed/pipeline/slam/slam_output.h>
#include <ceres_ed/pipeline/slam/slam_session.h>
#include <ceres_ed/pipeline/slam/warning_log.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ceres_ed {
namespace {

bool HasPoses(const DepthSource& sequence) {
  for (int i = 0; i < sequence.num_frames(); ++i) {
    if (sequence.given_pose(i) != nullptr) return true;
  }
  return false;
}

// Returns the points to follow. Their ids are their rows in the file.
StatusOr<std::vector<NamedPoint>> LoadPoints(const std::string& path, WarningLog* warnings) {
  std::vector<NamedPoint> points;
  if (path.empty()) return points;
  const StatusOr<LoadedCloud> loaded = LoadCloud(path);
  if (!loaded.ok()) return loaded.status();
  for (const std::string& warning : loaded->warnings) warnings->Add("track", warning);
  for (std::size_t i = 0; i < loaded->cloud.size(); ++i) {
    points.push_back({loaded->vertex_of_point[i], loaded->cloud.points[i]});
  }
  return points;
}

// Checks the output folder, because a run removes the results of an earlier run from it.
Outcome CheckOutputFolder(const SlamSettings& settings) {
  if (IsFolderOfSequence(settings.output, settings.input)) {
    return Outcome::Usage("--output=" + settings.output +
                          " is a folder of the sequence, expected another one");
  }
  if (!settings.resume && !settings.overwrite && HoldsResult(settings.output)) {
    return Outcome::Usage("--output=" + settings.output +
                          " holds a result already, expected another folder, --resume to "
                          "continue it or --overwrite to replace it");
  }
  return Outcome::Done();
}

}  // namespace

Outcome RunSlam(const SlamSettings& settings, const Timer& clock, SlamObserver* observer) {
  if (settings.predict != Challenge::kNone && !settings.track.empty()) {
    return Outcome::Usage("--predict=" + NameOf(settings.predict) +
                          " with --track=" + settings.track + ", expected one of them");
  }
  EnergyRegistry registry;
  const std::vector<EnergySpec>& energies = settings.options.levels.energies;
  Outcome outcome = LoadEnergies(settings.plugin, energies, &registry);
  if (!outcome.done()) return outcome;

  // Open the sequence and check the output folder.
  const StatusOr<std::unique_ptr<DepthSource>> sequence =
      OpenDepthSource(settings.input, settings.sequence, settings.stereo);
  if (!sequence.ok()) return Outcome::BadInput(sequence.status());
  outcome = CheckOutputFolder(settings);
  if (!outcome.done()) return outcome;
  Status prepared = PrepareSlamLook(settings);
  if (prepared.ok() && !settings.mesh.empty()) prepared = PrepareMapMesh(settings.mesh);
  if (!prepared.ok()) return Outcome::BadInput(prepared);
  observer->OnNote((*sequence)->description());
  WarningLog warnings(observer);
  for (const std::string& warning : IdlePluginWarnings(registry, energies)) {
    warnings.Add("plugin", warning);
  }
  for (const std::string& warning : (*sequence)->warnings()) warnings.Add("sequence", warning);
  if (settings.options.camera == CameraMode::kGiven && !HasPoses(**sequence)) {
    return Outcome::BadInput(
        Status::Error(settings.input + ": has no poses, expected some with --camera=given"));
  }
  // Create the tracker and run it.
  StatusOr<std::vector<NamedPoint>> points = LoadPoints(settings.track, &warnings);
  if (!points.ok()) return Outcome::BadInput(points.status());
  const StatusOr<ChallengePoints> challenge =
      ChallengePoints::Load(settings, **sequence, &warnings);
  if (!challenge.ok()) return Outcome::BadInput(challenge.status());
  if (settings.predict != Challenge::kNone) points = challenge->points();
  const StatusOr<std::unique_ptr<DeformableSlam>> slam =
      DeformableSlam::Create((*sequence)->camera(), settings.options, registry);
  if (!slam.ok()) {
    return Outcome::BadInput(Status::Error(settings.input + ": " + slam.status().message()));
  }
  SlamSession session(settings, **sequence, registry, slam->get(), &warnings, observer, clock);
  outcome = session.Start(*std::move(points));
  if (!outcome.done()) return outcome;
  outcome = session.Run();
  const bool has_result = outcome.done() || outcome.code == ExitCode::kStoppedEarly;
  if (has_result) {
    Status status = challenge->Write(settings.output, **sequence);
    if (status.ok() && !settings.mesh.empty()) {
      status = WriteMapMesh(settings.mesh, **slam, settings.options.growth.point_spacing);
    }
    if (status.ok()) status = WriteSlamLook(settings);
    if (!status.ok()) return Outcome::BadInput(status);
  }
  return outcome;
}

}  // namespace ceres_ed
