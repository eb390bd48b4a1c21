#include "apps/eval_sequence.h"

#include <ceres_ed/io/image_io.h>
#include <ceres_ed/pipeline/report.h>
#include <ceres_ed/version.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <apps/eval_result_files.h>
#include <apps/eval_sequence_files.h>
#include <apps/eval_sequence_report.h>
#include <apps/support/progress_bar.h>

namespace ceres_ed {
namespace {

constexpr SequenceEvaluationOptions kOptions;
constexpr TrackFollowingOptions kTrackOptions;

// Nothing where the picture can't be read: a sequence may have a bad frame in the middle.
StatusOr<std::optional<DepthImage>> LoadDepth(const SequenceFiles& sequence,
                                              int frame,
                                              std::vector<std::string>* warnings) {
  const auto path = sequence.depth_paths.find(frame);
  if (path == sequence.depth_paths.end()) return std::optional<DepthImage>();
  const CameraFile& file = sequence.camera;
  StatusOr<DepthImage> depth = ReadDepthImage(path->second, file.depth_units_per_metre);
  if (!depth.ok()) {
    warnings->push_back(depth.status().message() + "; its frame has no residual");
    return std::optional<DepthImage>();
  }
  if (depth->width() != file.camera.width || depth->height() != file.camera.height) {
    return Status::Error(path->second + ": " + std::to_string(depth->width()) + " x " +
                         std::to_string(depth->height()) + " pixels, expected " +
                         std::to_string(file.camera.width) + " x " +
                         std::to_string(file.camera.height) + " as in camera.txt");
  }
  return std::optional<DepthImage>(*std::move(depth));
}

StatusOr<SequenceFigures> Measure(const SequenceFiles& sequence,
                                  const ResultFiles& result,
                                  std::vector<std::string>* warnings) {
  const PinholeCamera& camera = sequence.camera.camera;
  SequenceFigures figures;
  figures.log = result.log;
  std::optional<TruthEvaluator> truth;
  if (sequence.truth) truth.emplace(camera, *sequence.truth, kOptions);
  std::optional<TrackFollower> tracks;
  if (!sequence.tracks.empty()) tracks.emplace(camera, sequence.tracks, kTrackOptions);

  ProgressBar bar("ed_eval", static_cast<int>(result.live_paths.size()), false);
  int done = 0;
  for (const auto& [frame, path] : result.live_paths) {
    const StatusOr<LiveSnapshot> snapshot = LoadLiveSnapshot(path, frame, warnings);
    if (!snapshot.ok()) return snapshot.status();
    if (truth) {
      const StatusOr<FrameTruthError> error = truth->Evaluate(*snapshot);
      if (!error.ok()) return Status::Error(path + ": " + error.status().message());
      figures.truth.push_back(*error);
    }
    const StatusOr<std::optional<DepthImage>> depth = LoadDepth(sequence, frame, warnings);
    if (!depth.ok()) return depth.status();
    if (*depth) figures.depth.push_back(CompareWithDepth(camera, *snapshot, **depth, kOptions));
    if (tracks) tracks->Add(*snapshot);
    bar.Update(++done, "frame " + std::to_string(frame));
  }
  if (tracks) figures.tracks = tracks->Evaluate();
  if (!sequence.true_poses.empty() && !result.trajectory.empty()) {
    const auto evaluation = EvaluateTrajectory(result.trajectory, sequence.true_poses);
    if (evaluation.ok()) {
      figures.camera = *evaluation;
    } else {
      warnings->push_back("trajectory.txt: " + evaluation.status().message());
    }
  }
  return figures;
}

nlohmann::ordered_json OptionsReport() {
  return {{"max_birth_offset", kOptions.max_birth_offset},
          {"visibility_tolerance", kOptions.visibility_tolerance},
          {"track_neighbors", kTrackOptions.neighbors},
          {"track_max_distance", kTrackOptions.max_distance}};
}

}  // namespace

Outcome EvaluateSequence(const EvalSettings& settings) {
  const StatusOr<SequenceFiles> sequence = LoadSequenceFiles(settings.sequence);
  if (!sequence.ok()) return Outcome::BadInput(sequence.status());
  const StatusOr<ResultFiles> result =
      LoadResultFiles(settings.result, settings.sequence, *sequence);
  if (!result.ok()) return Outcome::BadInput(result.status());
  std::vector<std::string> warnings = result->warnings;
  const StatusOr<SequenceFigures> figures = Measure(*sequence, *result, &warnings);
  if (!figures.ok()) return Outcome::BadInput(figures.status());

  for (const std::string& warning : warnings) {
    std::fprintf(stderr, "ed_eval: warning: %s\n", warning.c_str());
  }
  if (!settings.report.empty()) {
    nlohmann::ordered_json report = {{"program", "ed_eval"}, {"version", kVersion}};
    report["sequence"] = {{"path", settings.sequence}};
    report["result"] = {{"path", settings.result}, {"live_clouds", result->live_paths.size()}};
    report.update(SequenceReport(*figures));
    report["options"] = OptionsReport();
    report["warnings"] = warnings;
    report["flags"] = FlagsReport(settings.flags);
    if (Status status = WriteReport(settings.report, report); !status.ok()) {
      return Outcome::BadInput(status);
    }
  }
  std::fputs(SequenceTables(*figures).c_str(), stdout);
  return Outcome::Done();
}

}  // namespace ceres_ed
