#include "apps/slam_run.h"

#include <ceres_ed/io/cloud_io.h>
#include <ceres_ed/pipeline/energies.h>
#include <ceres_ed/util/timer.h>

#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <apps/slam_flags.h>
#include <apps/slam_session.h>
#include <apps/support/run_flags.h>

namespace ceres_ed {
namespace {

bool HasPoses(const DepthSequence& sequence) {
  for (int i = 0; i < sequence.num_frames(); ++i) {
    if (sequence.given_pose(i) != nullptr) return true;
  }
  return false;
}

// The points of --track; their ids are the rows of the file.
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

}  // namespace

Outcome RunSlam(const std::vector<std::string>& arguments) {
  const Timer clock;
  InstallStopHandler();
  StatusOr<SlamCommand> settings = ReadSlamFlags();
  if (!settings.ok()) return Outcome::Usage(settings.status().message());
  settings->flags = CurrentFlags();
  EnergyRegistry registry;
  const std::vector<EnergySpec>& energies = settings->options.levels.energies;
  Outcome outcome = LoadEnergies(settings->plugin, energies, &registry);
  if (outcome.code != ExitCode::kDone) return outcome;

  const StatusOr<std::unique_ptr<DepthSequence>> sequence =
      OpenSequence(arguments[0], settings->sequence);
  if (!sequence.ok()) return Outcome::BadInput(sequence.status());
  if (!settings->quiet) {
    std::fprintf(stderr, "ed_slam: %s\n", (*sequence)->description().c_str());
  }
  WarningLog warnings("ed_slam");
  for (const std::string& warning : IdlePluginWarnings(registry, energies)) {
    warnings.Add("plugin", warning);
  }
  for (const std::string& warning : (*sequence)->warnings()) warnings.Add("sequence", warning);
  if (settings->options.camera == CameraMode::kGiven && !HasPoses(**sequence)) {
    return Outcome::BadInput(
        Status::Error(arguments[0] + ": has no poses, expected some with --camera=given"));
  }
  StatusOr<std::vector<NamedPoint>> points = LoadPoints(settings->track, &warnings);
  if (!points.ok()) return Outcome::BadInput(points.status());
  const StatusOr<std::unique_ptr<DeformableSlam>> slam =
      DeformableSlam::Create((*sequence)->camera(), settings->options, registry);
  if (!slam.ok()) {
    return Outcome::BadInput(Status::Error(arguments[0] + ": " + slam.status().message()));
  }
  SlamSession session(*settings, arguments[0], **sequence, registry, slam->get(), clock);
  outcome = session.Start(*std::move(points), &warnings);
  return outcome.code == ExitCode::kDone ? session.Run() : outcome;
}

}  // namespace ceres_ed
